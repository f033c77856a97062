// Loads a tool path while it is drawn: the server interprets as far as the page reads, and stops when the page leaves.
import { useEffect, useState } from 'preact/hooks';
import type { PathBegin, PathEnd } from '../../generated/api';
import { ApiError, fetchApi, pathOf, withQuery } from '../api/request';
import { faultText } from '../parts/command';
import { PathDecoder } from './decoder';
import { kMaxPoints, Polyline } from './polyline';

/// Where a path is so long that its points would be left out anyway, the server leaves them out: fewer bytes.
const kLongProgram = 80 * 1024 * 1024;
const kLongTolerance = 0.01; // mm

export interface PathInput {
  program: string;
  revision: number;
  size: number;
  machine: string;
  /// More are left out where that is seen least.
  maxPoints?: number;
}

export interface LoadedPath {
  polyline: Polyline;
  /// Another number: there are more points.
  version: number;
  begin: PathBegin | null;
  end: PathEnd | null;
  fault: string | null;
  blocks: number;
}

/// What has arrived is shown as often while more follows: drawing must not hold up reading.
const kShowMs = 150;

/// The server sends a few paths at a time: then it is asked again.
const kBusy = 503;
const kBusyMs = 2000;

async function request(input: PathInput, tolerance: number | null, signal: AbortSignal): Promise<Response> {
  const { program, revision, machine } = input;
  for (;;) {
    try {
      return await fetchApi('GET', withQuery(pathOf('programs', program, 'path'), { revision, machine, tolerance }), {}, signal);
    } catch (failure) {
      if (!(failure instanceof ApiError) || failure.status !== kBusy) throw failure;
    }
    await new Promise((done) => setTimeout(done, kBusyMs));
    signal.throwIfAborted();
  }
}

export function usePath(input: PathInput): LoadedPath {
  const { program, revision, size, machine, maxPoints = kMaxPoints } = input;
  const empty = (): LoadedPath => ({ polyline: new Polyline(maxPoints), version: 0, begin: null, end: null, fault: null, blocks: 0 });
  const [state, setState] = useState(empty);
  useEffect(() => {
    const ending = new AbortController();
    const next = empty();
    let isWaiting = false;
    const show = () => {
      if (isWaiting) return;
      isWaiting = true;
      setTimeout(() => {
        isWaiting = false;
        if (ending.signal.aborted) return;
        ++next.version;
        setState({ ...next });
      }, next.end === null ? kShowMs : 0);
    };
    const decoder = new PathDecoder(next.polyline, (note) => {
      if (note.kind === 'begin') next.begin = note;
      if (note.kind === 'end') next.end = note;
      if (note.kind !== 'begin') next.blocks = note.blocks;
    });
    const read = async () => {
      const tolerance = size > kLongProgram ? kLongTolerance : null;
      next.polyline.tolerance = tolerance ?? 0;
      const response = await request(input, tolerance, ending.signal);
      const reader = response.body!.getReader();
      for (;;) {
        const { done, value } = await reader.read();
        if (done) return;
        decoder.take(value);
        show();
      }
    };
    setState(next);
    read().then(show, (failure: unknown) => {
      if (ending.signal.aborted) return;
      next.fault = faultText(failure, false);
      show();
    });
    return () => ending.abort();
  }, [program, revision, machine]);
  return state;
}
