// The address of a view is the part after `#`, so that the server has one page and a view can be bookmarked:
// #/floor?state=alarm   #/machine/lathe-1   #/programs/O0100
export interface Route {
  view: string;
  /// What follows the view: names, decoded.
  path: string[];
  query: URLSearchParams;
}

export function parseRoute(hash: string): Route {
  const [place = '', query = ''] = hash.replace(/^#?\/?/, '').split('?', 2);
  const [view = '', ...path] = place.split('/').map(decode);
  return { view: view || 'floor', path: path.filter((part) => part !== ''), query: new URLSearchParams(query) };
}

/// A hand-typed address may hold a stray `%`.
function decode(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}

export function addressOf(view: string, path: string[] = [], query: Record<string, string> = {}): string {
  const place = [view, ...path].map(encodeURIComponent).join('/');
  const chosen = Object.entries(query).filter(([, value]) => value !== '');
  const rest = new URLSearchParams(chosen).toString();
  return `#/${place}${rest === '' ? '' : `?${rest}`}`;
}
