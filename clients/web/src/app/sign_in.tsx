// Asks for the server's token, and tries it before it is kept.
import { useState } from 'preact/hooks';
import { authorization, signIn } from '../api/session';
import { pathOf } from '../api/request';
import { texts } from '../texts/texts';

/// What kept it from signing in; null: it is signed in.
async function trySignIn(token: string, remembers: boolean): Promise<string | null> {
  const t = texts();
  if (!/^[\x21-\x7e]+$/.test(token)) return t.signIn.denied; // no header could carry it
  try {
    const answer = await fetch(pathOf('server'), { headers: authorization(token), cache: 'no-store' });
    if (answer.status === 401) return t.signIn.denied;
    if (!answer.ok) return `${answer.status} ${answer.statusText}`;
  } catch {
    return t.errors.unreachable;
  }
  signIn(token, remembers);
  return null;
}

export function SignIn() {
  const t = texts();
  const [token, setToken] = useState('');
  const [remembers, setRemembers] = useState(false);
  const [fault, setFault] = useState<string | null>(null);
  const submit = async (event: Event) => {
    event.preventDefault();
    setFault(await trySignIn(token.trim(), remembers));
  };
  return (
    <main class="sign-in">
      <form onSubmit={(event) => void submit(event)}>
        <h1>{t.app.title}</h1>
        <label>
          {t.signIn.token}
          <input type="password" name="token" autocomplete="current-password" required value={token}
            aria-describedby="token-hint" onInput={(e) => setToken(e.currentTarget.value)} />
        </label>
        <p id="token-hint" class="hint">{t.signIn.hint}</p>
        <label class="check">
          <input type="checkbox" checked={remembers} aria-describedby="remember-hint" onChange={(e) => setRemembers(e.currentTarget.checked)} />
          {t.signIn.remember}
        </label>
        <p id="remember-hint" class="hint">{t.signIn.rememberHint}</p>
        {fault && <p class="notice bad" role="alert">{fault}</p>}
        <button type="submit" class="primary">{t.signIn.submit}</button>
      </form>
    </main>
  );
}
