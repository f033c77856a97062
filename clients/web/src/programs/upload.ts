// Stores a file as a program's new revision or as an attachment, in pieces. What has arrived is kept by the server: after a lost connection the next attempt
// continues where it stopped, since a piece names its place and is stored once.
import type { Attachment, CommittedRevision, Upload } from '../../generated/api';
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

/// What begins an upload, and what becomes of its bytes.
interface Ends<T> {
  begin(): Promise<Upload>;
  finish(id: string, force: boolean): Promise<T>;
}

export class PieceUpload<T> {
  private id: string | null = null;
  private hasAll = false;

  constructor(private readonly file: Blob, private readonly ends: Ends<T>, private readonly onProgress: (fraction: number) => void) {}

  /// Begins, or continues after a failure. `force` replaces a program that is protected against change.
  async run(force = false): Promise<T> {
    const upload = await this.begin();
    if (!this.hasAll) await this.sendPieces(upload);
    this.hasAll = true;
    return this.ends.finish(upload.id, force);
  }

  /// Nothing of it stays at the server.
  async drop(): Promise<void> {
    if (this.id !== null) await send('DELETE', pathOf('uploads', this.id));
  }

  private async begin(): Promise<Upload> {
    if (this.id !== null) return get<Upload>(pathOf('uploads', this.id));
    const upload = await this.ends.begin();
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

export function programUpload(file: Blob, { program, control, comment }: UploadOptions, onProgress: (fraction: number) => void): PieceUpload<CommittedRevision> {
  const request = { program, ...(control !== null && { control }), ...(comment !== '' && { comment }) };
  return new PieceUpload(file, {
    begin: () => send<Upload>('POST', pathOf('uploads'), { json: request }),
    finish: (id, force) => send<CommittedRevision>('POST', pathOf('uploads', id, 'commit'), { json: force ? { force } : {} }),
  }, onProgress);
}

export interface AttachmentOptions {
  program: string;
  /// null: it belongs to the program.
  revision: number | null;
  name: string;
}

export function attachmentUpload(file: Blob, { program, revision, name }: AttachmentOptions, onProgress: (fraction: number) => void): PieceUpload<Attachment> {
  const request = { name, ...(revision !== null && { revision }) };
  return new PieceUpload(file, {
    begin: () => send<Upload>('POST', pathOf('programs', program, 'attachments'), { json: request }),
    finish: (id) => send<Attachment>('POST', pathOf('uploads', id, 'attach'), { json: {} }),
  }, onProgress);
}
