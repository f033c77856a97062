// A shop of its own for a test: a real dncd and real gateways with simulated machines, in a temporary folder, on loopback.
import { spawn, type ChildProcess } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';

const kBin = process.env.DRIPLINE_BIN!;
/// Of every user of a shop.
export const kPassword = 'correct horse battery';
const kDomain = process.env.DDS_DOMAIN ?? '77';

export interface MachineOptions {
  control: string;
  speed?: string;
  setup?: string;
  description?: string;
  more?: string[];
}

export class Shop {
  readonly folder = mkdtempSync(path.join(tmpdir(), 'dripline-web-'));
  url = '';
  private server: ChildProcess | null = null;
  private readonly gateways = new Map<string, ChildProcess>();
  private readonly sessions = new Map<string, { name: string; value: string }>();
  readonly network = ['--dds-domain', kDomain, '--dds-tag', `web-${process.pid}`];

  get serverPid(): number | undefined {
    return this.server?.pid;
  }

  get token(): string {
    return readFileSync(path.join(this.folder, 'server/token'), 'utf8').trim();
  }

  /// The cookie of a session; the user's password is kPassword.
  async sessionOf(user: string): Promise<{ name: string; value: string }> {
    const known = this.sessions.get(user);
    if (known) return known;
    if (user === 'admin') await this.api('PUT', 'users/admin/password', { password: kPassword });
    const answer = await fetch(`${this.url}/api/v1/session`, {
      method: 'POST', headers: { 'X-Dripline': '1' }, body: JSON.stringify({ user, password: kPassword }),
    });
    const [, name, value] = /^([^=]+)=([^;]+)/.exec(answer.headers.get('set-cookie') ?? '') ?? [];
    if (name === undefined || value === undefined) throw new Error(`${user} cannot sign in: ${answer.status}`);
    this.sessions.set(user, { name, value });
    return { name, value };
  }

  async addUser(name: string, role: string, groups: string[] = []): Promise<void> {
    if (!(await this.api('POST', 'users', { name, role, groups, password: kPassword }))) throw new Error(`user ${name} is refused: ${this.lastRefusal}`);
  }

  /// Of the server besides its place: of every start.
  serverArgs: string[] = [];

  /// After a stop it listens where it did before.
  async startServer(): Promise<void> {
    const announced = path.join(this.folder, 'server/dncd.json');
    rmSync(announced, { force: true });
    const address = this.url ? new URL(this.url).host : '127.0.0.1:0';
    this.server = this.spawn('dncd', ['--state', path.join(this.folder, 'server'), '--http', address, ...this.serverArgs]);
    const server = this.server;
    await until('the server listens', () => {
      if (server.exitCode !== null) throw new Error(`the server has ended: ${readFileSync(this.logOf('dncd'), 'utf8')}`);
      return existsSync(announced) && this.readUrl(announced);
    });
  }

  private logOf(program: string): string {
    return path.join(this.folder, `${program}-${this.gateways.size}.log`);
  }

  private readUrl(announced: string): boolean {
    try {
      this.url = (JSON.parse(readFileSync(announced, 'utf8')) as { url: string }).url;
      return true;
    } catch {
      return false; // half written
    }
  }

  async stopServer(): Promise<void> {
    if (this.server) await end(this.server);
    this.server = null;
  }

  async startMachine(name: string, options: MachineOptions): Promise<void> {
    const setup: string[] = [];
    if (options.setup !== undefined) {
      const file = path.join(this.folder, `${name}.toml`);
      writeFileSync(file, options.setup);
      setup.push('--setup', file);
    }
    this.gateways.set(name, this.spawn('dncgw', [
      '--machine', name, '--control', options.control, '--state', path.join(this.folder, name), '--speed', options.speed ?? '1x',
      '--description', options.description ?? '', ...setup, ...(options.more ?? [])]));
    await until(`${name} is connected`, async () => (await this.api<{ connected: boolean }>('GET', `machines/${name}`))?.connected === true);
  }

  async stopMachine(name: string): Promise<void> {
    await end(this.gateways.get(name)!);
    this.gateways.delete(name);
  }

  /// At the machine's own panel.
  async panel(machine: string, ...action: string[]): Promise<void> {
    const child = spawn(path.join(kBin, 'dncgw'), ['panel', '--machine', machine, '--state', path.join(this.folder, machine), ...action], { stdio: 'ignore' });
    await new Promise((done) => child.on('exit', done));
  }

  /// Why `api` gave null.
  lastRefusal = '';

  /// null: the server refused, or did not answer. `user` instead of the token of admin.
  async api<T>(method: string, what: string, body?: unknown, user?: string): Promise<T | null> {
    try {
      const raw = typeof body === 'string' ? body : body === undefined ? null : JSON.stringify(body);
      const { name, value } = user === undefined ? { name: '', value: '' } : await this.sessionOf(user);
      const headers: Record<string, string> = user === undefined ? { Authorization: `Bearer ${this.token}` } : { Cookie: `${name}=${value}`, 'X-Dripline': '1' };
      const answer = await fetch(`${this.url}/api/v1/${what}`, { method, headers, body: raw });
      if (answer.ok) return (answer.status === 204 ? {} : await answer.json()) as T;
      this.lastRefusal = await answer.text();
    } catch (failure) {
      this.lastRefusal = String(failure);
    }
    return null;
  }

  async push(name: string, text: string, control: string, comment?: string, user?: string): Promise<void> {
    const upload = await this.api<{ id: string }>('POST', 'uploads', { program: name, control, ...(comment !== undefined && { comment }) }, user);
    if (!upload) throw new Error(`program ${name} is refused: ${this.lastRefusal}`);
    await this.api('PUT', `uploads/${upload.id}/content?offset=0`, text, user);
    if (!(await this.api('POST', `uploads/${upload.id}/commit`, {}, user))) throw new Error(`program ${name} is not committed: ${this.lastRefusal}`);
  }

  async start(machine: string, program: string): Promise<string> {
    const run = await this.api<{ id: string }>('POST', 'runs', { machine, program });
    if (!run) throw new Error(`${program} does not start on ${machine}: ${this.lastRefusal}`);
    return run.id;
  }

  async stop(): Promise<void> {
    for (const name of [...this.gateways.keys()]) await this.stopMachine(name);
    await this.stopServer();
    rmSync(this.folder, { recursive: true, force: true });
  }

  private spawn(program: string, args: string[]): ChildProcess {
    return spawn(path.join(kBin, program), [...args, ...this.network, '--log', this.logOf(program)], { stdio: 'ignore' });
  }
}

/// A gcode of `blocks` short moves, some of a second each at 1x.
export function longProgram(number: string, blocks: number): string {
  const moves = Array.from({ length: blocks }, (_, i) => `N${(i + 1) * 10} G1 X${(i % 2) * 10}. Y${i % 50}. F600.`);
  return [`${number} (PLATE, SECOND SIDE)`, 'G21 G90 G94', ...moves, 'M30', ''].join('\n');
}

/// Prints `count` values, as a lathe does that measures its part.
export function measuringProgram(count: number): string {
  const lines = Array.from({ length: count }, (_, i) => `DPRNT [X${(10 + i / 10).toFixed(2)} Z${(-2 + Math.sin(i / 4) / 4).toFixed(4)}]`);
  return ['O0500 (MEASURE THE FACE)', 'G20 G93 G98', 'POPEN P0', ...lines, 'PCLOS', 'M30', ''].join('\n');
}

export async function until(what: string, holds: () => boolean | Promise<boolean>, limitMs = 60_000): Promise<void> {
  const end = Date.now() + limitMs;
  while (!(await holds())) {
    if (Date.now() > end) throw new Error(`not within ${limitMs} ms: ${what}`);
    await new Promise((done) => setTimeout(done, 50));
  }
}

function end(child: ChildProcess): Promise<void> {
  if (child.exitCode !== null || child.signalCode !== null) return Promise.resolve();
  return new Promise((done) => {
    child.on('exit', () => done());
    child.kill('SIGTERM');
  });
}
