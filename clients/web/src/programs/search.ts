// The words of a search, as the server reads them, and where they are in a line. The choices of a list are its address. Pure but for the loading.
import type { Program, Programs, SearchResult } from '../../generated/api';
import { get, pathOf } from '../api/request';

export const kFilters = ['part', 'operation', 'material', 'machine_group', 'control', 'author', 'state'] as const;
export type Filter = (typeof kFilters)[number];
export type Filters = Record<Filter, string>;

export function filtersOf(query: URLSearchParams): Filters {
  return Object.fromEntries(kFilters.map((filter) => [filter, query.get(filter) ?? ''])) as Filters;
}

export const kPage = 200;

/// By name, past `after`.
export async function listPrograms(filters: Filters, after: string, signal: AbortSignal, limit = kPage): Promise<Program[]> {
  return (await get<Programs>(pathOf('programs'), { ...filters, after, limit }, signal)).programs;
}

/// What is typed is searched for while it is typed: the last word may be the beginning of one. The server takes beginnings of letters alone, of three at least.
export function wordsToSend(typed: string): string {
  const words = typed.trim();
  return /(^|\s)\p{L}{3,}$/u.test(words) ? `${words}*` : words;
}

interface Hits {
  typed: string;
  filters: Filters;
  /// Also revisions that a newer one has replaced.
  replaced: boolean;
  /// `next` of the page before.
  before: number | null;
}

export function findPrograms({ typed, filters, replaced, before }: Hits, signal: AbortSignal): Promise<SearchResult> {
  return get<SearchResult>(pathOf('search'), { words: wordsToSend(typed), ...filters, replaced: replaced || null, before, limit: 50 }, signal);
}

const kNamed = 20;

/// Programs whose names begin so, also in capitals. The list is in the order of names, so that they are those past the last shorter one.
export async function namedSo(typed: string, filters: Filters, signal: AbortSignal): Promise<Program[]> {
  const beginnings = [...new Set([typed.trim(), typed.trim().toUpperCase()])].filter((beginning) => beginning !== '');
  const lists = await Promise.all(beginnings.map((beginning) => listPrograms(filters, beforeName(beginning), signal, kNamed)));
  return beginnings.flatMap((beginning, i) => lists[i]!.filter((program) => program.name.startsWith(beginning)));
}

/// A text that sorts before `name` and after every smaller name of its length: of "O07" "O06" and the last of all characters.
export function beforeName(name: string): string {
  const last = name.charCodeAt(name.length - 1);
  return `${name.slice(0, -1)}${String.fromCharCode(last - 1)}\u{10ffff}`;
}

export interface TextPart {
  text: string;
  isFound: boolean;
}

/// The words that were searched for, where they are in `text` letter by letter; G1 that is written G01 is found by the server alone.
export function markWords(text: string, typed: string): TextPart[] {
  const words = typed.toLowerCase().split(/\s+/).map((word) => word.replace(/\*$/, '')).filter((word) => word !== '');
  const lower = text.toLowerCase();
  if (words.length === 0 || lower.length !== text.length) return [{ text, isFound: false }];
  const found = new Array<boolean>(text.length).fill(false);
  for (const word of words) {
    for (let at = lower.indexOf(word); at >= 0; at = lower.indexOf(word, at + 1)) found.fill(true, at, at + word.length);
  }
  const parts: TextPart[] = [];
  for (let i = 0; i < text.length; ++i) {
    const last = parts[parts.length - 1];
    if (last && last.isFound === found[i]) last.text += text[i];
    else parts.push({ text: text[i]!, isFound: found[i]! });
  }
  return parts;
}
