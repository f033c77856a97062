// Who is signed in. The one place that knows how a request proves it: today by the server's token.
const kKey = 'dripline.token';

let token: string | null = read();
const listeners = new Set<() => void>();

function read(): string | null {
  try {
    return sessionStorage.getItem(kKey) ?? localStorage.getItem(kKey);
  } catch {
    return null;
  }
}

export function isSignedIn(): boolean {
  return token !== null;
}

/// `remembers`: this computer stays signed in when the browser is closed, as a screen on the wall has to.
export function signIn(secret: string, remembers: boolean): void {
  token = secret;
  try {
    (remembers ? localStorage : sessionStorage).setItem(kKey, secret);
  } catch {
    // Signed in as long as the page is open.
  }
  announce();
}

/// Also what follows when the server no longer accepts the token.
export function signOut(): void {
  token = null;
  try {
    sessionStorage.removeItem(kKey);
    localStorage.removeItem(kKey);
  } catch {
    // Nothing was kept.
  }
  announce();
}

export function authorization(secret: string | null = token): Record<string, string> {
  return secret === null ? {} : { Authorization: `Bearer ${secret}` };
}

export function onSession(listener: () => void): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

function announce(): void {
  for (const listener of [...listeners]) listener();
}
