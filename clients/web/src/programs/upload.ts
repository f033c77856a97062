// Stores a file as a program's new revision, in pieces. What has arrived is kept by the server: after a lost connection the next attempt
// continues where it stopped, since a piece names its place and is stored once.
import type { CommittedRevision, Upload } from '../../generated/api';
import { get, pathOf, send, withQuery } from '../api/request';

export interface UploadOptions {
  program: string;
  /// null: the server finds it in the text, or refuses with the names to choose from.
  control: string | null;
  comment: string;
}

/// "O0100.nc" is program O0100: what controls call a program has no ending.
export function programNameOf(file: string): string {
  return file.replace(/\.[A-Za-z0-9]{1,4}$/, '') || file;
}

export class ProgramUpload {
  private id: string | null = null;
  private hasAll = false;

  constructor(private readonly file: Blob, private readonly options: UploadOptions, private readonly onProgress: (fraction: number) => void) {}

  /// Begins, or continues after a failure. `force` replaces a program that is protected against change.
  async run(force = false): Promise<CommittedRevision> {
    const upload = await this.begin();
    if (!this.hasAll) await this.sendPieces(upload);
    this.hasAll = true;
    return send<CommittedRevision>('POST', pathOf('uploads', upload.id, 'commit'), { json: force ? { force } : {} });
  }

  /// Nothing of it stays at the server.
  async drop(): Promise<void> {
    if (this.id !== null) await send('DELETE', pathOf('uploads', this.id));
  }

  private async begin(): Promise<Upload> {
    if (this.id !== null) return get<Upload>(pathOf('uploads', this.id));
    const { program, control, comment } = this.options;
    const request = { program, ...(control !== null && { control }), ...(comment !== '' && { comment }) };
    const upload = await send<Upload>('POST', pathOf('uploads'), { json: request });
    this.id = upload.id;
    return upload;
  }

  private async sendPieces(upload: Upload): Promise<void> {
    let { received } = upload;
    while (received < this.file.size) {
      const raw = this.file.slice(received, received + upload.max_piece);
      ({ received } = await send<Upload>('PUT', withQuery(pathOf('uploads', upload.id, 'content'), { offset: received }), { raw }));
      this.onProgress(received / this.file.size);
    }
  }
}
