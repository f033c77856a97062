// All programs of the server, page by page, and those that fit a search. Pure but for the loading.
import type { Program, Programs } from '../../generated/api';
import { get, pathOf } from '../api/request';

const kPage = 1000;
const kMax = 20_000;

export async function loadPrograms(signal: AbortSignal): Promise<Program[]> {
  const all: Program[] = [];
  while (all.length < kMax) {
    const { programs } = await get<Programs>(pathOf('programs'), { limit: kPage, offset: all.length }, signal);
    all.push(...programs);
    if (programs.length < kPage) break;
  }
  return all;
}

export function searchPrograms(programs: Program[], text: string): Program[] {
  const words = text.toLowerCase().split(/\s+/).filter((word) => word !== '');
  return programs.filter((p) => {
    const about = [p.name, p.title, p.control, p.comment, p.author].join(' ').toLowerCase();
    return words.every((word) => about.includes(word));
  });
}
