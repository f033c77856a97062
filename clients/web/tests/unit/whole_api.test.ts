// Whatever the API can do, the page can: each path of the OpenAPI description is built somewhere in the page's source.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';

const kWeb = process.env.WEB!;

/// Paths that the page does not need, each with its reason.
const kOthers: { [path: string]: string } = {
  health: 'of monitoring; the page shows the server state',
  ready: 'of monitoring',
  metrics: 'of monitoring',
  'openapi.json': 'of programmers',
  reports: 'the page lists runs, with those that have lines',
  'machines/{name}': 'the event stream and the list bring machines whole',
  'offsets/{id}': 'the list brings proposals whole',
  'machines/{name}/jog/hold': 'dnc holds a jog; the page moves by steps, which need no repeated request',
};

function sourcesOf(folder: string): string[] {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const name = path.join(folder, entry.name);
    if (entry.isDirectory()) return sourcesOf(name);
    return /\.tsx?$/.test(name) ? [readFileSync(name, 'utf8')] : [];
  });
}

/// The arguments of a call whose text begins behind its bracket.
function argumentsAt(text: string): string[] {
  const found: string[] = [];
  let depth = 0;
  let begin = 0;
  for (let at = 0; at < text.length; ++at) {
    const character = text[at]!;
    if (depth === 0 && (character === ',' || character === ')')) {
      found.push(text.slice(begin, at).trim());
      begin = at + 1;
      if (character === ')') break;
    }
    if ('([{'.includes(character)) ++depth;
    else if (')]}'.includes(character)) --depth;
  }
  return found;
}

/// Of `pathOf('programs', name, 'copy')`: ['programs', '*', 'copy']; `...rest` is '**'.
function pathsOf(source: string): string[][] {
  return [...source.matchAll(/(?<!function )pathOf\(/g)].map((call) =>
    argumentsAt(source.slice(call.index! + call[0].length)).map((argument) => (argument.startsWith('...') ? '**' : /^'(.*)'$/.exec(argument)?.[1] ?? '*')));
}

function fits(path: string[], built: string[]): boolean {
  const [first, ...rest] = built;
  if (first === undefined) return path.length === 0;
  if (first === '**') return path.some((_, at) => fits(path.slice(at), rest)) || fits([], rest);
  if (path.length === 0) return false;
  const isName = path[0]!.startsWith('{');
  return (isName ? first === '*' : first === path[0] || first === '*') && fits(path.slice(1), rest);
}

test('every path of the API is used by the page, or its absence has a reason', () => {
  const api = JSON.parse(readFileSync(path.join(kWeb, '../../server/api/openapi.json'), 'utf8')) as { paths: { [path: string]: unknown } };
  const built = sourcesOf(path.join(kWeb, 'src')).flatMap(pathsOf).filter(([first]) => first !== '*' && first !== '**');
  const unused = Object.keys(api.paths).map((whole) => whole.replace('/api/v1/', '')).filter((whole) => !built.some((one) => fits(whole.split('/'), one)));
  assert.deepEqual(unused.sort(), Object.keys(kOthers).sort());
});
