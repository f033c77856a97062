// One request to the server's API. A request is made once: what changes something is never repeated by the page, since a command
// whose answer was lost may have been carried out.
export type Code = 'syntax' | 'conflict' | 'unsupported' | 'limit_exceeded' | 'not_found' | 'busy' | 'timeout' | 'corrupt' | 'io' | 'denied';

/// What the server answered instead. `status` 0: no answer came, so that a command may have been carried out.
export class ApiError extends Error {
  constructor(readonly status: number, readonly code: Code | null, message: string) {
    super(message);
  }
}

export type Query = Record<string, string | number | boolean | null | undefined>;

/// Segments of a path are names that others chose: each is escaped.
export function pathOf(...segments: Array<string | number>): string {
  return `/api/v1/${segments.map((segment) => encodeURIComponent(segment)).join('/')}`;
}

export function withQuery(path: string, query: Query): string {
  const given = Object.entries(query).filter(([, value]) => value !== null && value !== undefined && value !== '');
  if (given.length === 0) return path;
  return `${path}?${new URLSearchParams(given.map(([name, value]) => [name, String(value)]))}`;
}

export interface Body {
  json?: unknown;
  raw?: Blob | string;
  /// Of the answer: "bytes=0-99".
  range?: string;
  headers?: Record<string, string>;
}

/// By this field the server knows a request of its own page from one that another site made the browser send.
const kPageHeader = { 'X-Dripline': '1' };

const statusListeners = new Set<(status: number) => void>();

/// The status of every answer that is an error.
export function onStatus(listener: (status: number) => void): void {
  statusListeners.add(listener);
}

export async function fetchApi(method: string, path: string, body: Body = {}, signal?: AbortSignal): Promise<Response> {
  const headers: Record<string, string> = { ...kPageHeader, ...body.headers };
  if (body.json !== undefined) headers['Content-Type'] = 'application/json';
  else if (body.raw !== undefined) headers['Content-Type'] = 'application/octet-stream';
  if (body.range !== undefined) headers.Range = body.range;
  const content = body.json !== undefined ? JSON.stringify(body.json) : body.raw;
  let response: Response;
  try {
    response = await fetch(path, { method, headers, cache: 'no-store', ...(content !== undefined && { body: content }), ...(signal && { signal }) });
  } catch (failure) {
    if (signal?.aborted) throw failure;
    throw new ApiError(0, null, '');
  }
  if (response.ok) return response;
  const error = await errorOf(response);
  for (const listener of statusListeners) listener(response.status);
  throw error;
}

async function errorOf(response: Response): Promise<ApiError> {
  try {
    const { error } = (await response.json()) as { error: { code: Code; message: string } };
    return new ApiError(response.status, error.code, error.message);
  } catch {
    return new ApiError(response.status, null, `${response.status} ${response.statusText}`);
  }
}

export async function get<T>(path: string, query: Query = {}, signal?: AbortSignal, headers: Record<string, string> = {}): Promise<T> {
  return (await (await fetchApi('GET', withQuery(path, query), { headers }, signal)).json()) as T;
}

/// null: there is none of it (404).
export async function getIfThere<T>(path: string, query: Query = {}, signal?: AbortSignal): Promise<T | null> {
  try {
    return await get<T>(path, query, signal);
  } catch (failure) {
    if (failure instanceof ApiError && failure.status === 404) return null;
    throw failure;
  }
}

/// The answer's JSON; undefined for one without content. After `limitMs` it is as if no answer came: a server that is frozen gives none.
export async function send<T = void>(method: 'POST' | 'PUT' | 'DELETE', path: string, body: Body = {}, limitMs?: number): Promise<T> {
  const limit = limitMs === undefined ? undefined : AbortSignal.timeout(limitMs);
  try {
    const response = await fetchApi(method, path, body, limit);
    return (response.status === 204 ? undefined : await response.json()) as T;
  } catch (failure) {
    if (limit?.aborted) throw new ApiError(0, null, '');
    throw failure;
  }
}
