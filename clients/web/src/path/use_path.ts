// Loads a tool path while it is drawn: the server interprets as far as the page reads, and stops when the page leaves.
import { useEffect, useRef, useState } from 'preact/hooks';
import type { PathBegin, PathEnd } from '../../generated/api';
import { fetchApi, pathOf, withQuery } from '../api/request';
import { faultText } from '../parts/command';
import { PathDecoder } from './decoder';
import { Polyline } from './polyline';

/// Where a path is so long that its points would be left out anyway, the server leaves them out: fewer bytes.
const kLongProgram = 80 * 1024 * 1024;
const kLongTolerance = 0.01; // mm

export interface PathInput {
  program: string;
  revision: number;
  size: number;
  machine: string;
}

export interface LoadedPath {
  polyline: Polyline;
  begin: PathBegin | null;
  end: PathEnd | null;
  fault: string | null;
  blocks: number;
}

/// What has arrived is shown as often while more follows: drawing must not hold up reading.
const kShowMs = 150;

/// `onMore` follows new points.
export function usePath({ program, revision, size, machine }: PathInput, onMore: () => void): LoadedPath {
  const empty = (): LoadedPath => ({ polyline: new Polyline(), begin: null, end: null, fault: null, blocks: 0 });
  const [state, setState] = useState(empty);
  const more = useRef(onMore);
  more.current = onMore;
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
        setState({ ...next });
        more.current();
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
      const response = await fetchApi('GET', withQuery(pathOf('programs', program, 'path'), { revision, machine, tolerance }), {}, ending.signal);
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
