// A control at the other end of a serial line, as far as the server sees it: a TCP device server that punches out what a test gives it.
import { createServer, type AddressInfo, type Server, type Socket } from 'node:net';
import { until } from './shop';

export class LineControl {
  private socket: Socket | null = null;
  private received = '';

  private constructor(private readonly server: Server) {
    server.on('connection', (socket) => {
      this.socket = socket;
      socket.unref(); // it ends with the process, at the latest
      socket.on('data', (bytes) => { this.received += bytes.toString('latin1'); });
      socket.on('error', () => {}); // the server reopens its lines
    });
  }

  static async listen(): Promise<LineControl> {
    const server = createServer().unref();
    await new Promise<void>((done) => server.listen(0, '127.0.0.1', done));
    return new LineControl(server);
  }

  get address(): string {
    return `tcp://127.0.0.1:${(this.server.address() as AddressInfo).port}`;
  }

  get text(): string {
    return this.received;
  }

  async punch(text: string): Promise<void> {
    await until('the line is open', () => this.socket !== null && !this.socket.destroyed);
    this.socket!.write(text);
  }

  end(): void {
    this.socket?.destroy();
    this.server.close();
  }
}
