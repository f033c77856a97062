// Asks for user and password: instead of the page, or before it when a session has ended, so that nothing typed is lost.
import { useState } from 'preact/hooks';
import { ApiError } from '../api/request';
import { setFirstPassword, signIn } from '../api/session';
import { texts } from '../texts/texts';

const kWallHours = 720; // the longest the server allows

function faultOf(failure: unknown): string {
  if (failure instanceof ApiError) return failure.status === 0 ? texts().errors.unreachable : failure.message;
  return String(failure);
}

/// What kept it from being done; null while it is in progress or not tried.
function useAttempt(action: () => Promise<void>) {
  const [fault, setFault] = useState<string | null>(null);
  const [isBusy, setBusy] = useState(false);
  const submit = async (event: Event) => {
    event.preventDefault();
    setBusy(true);
    setFault(null);
    await action().catch((failure: unknown) => setFault(faultOf(failure)));
    setBusy(false);
  };
  return { fault, isBusy, submit };
}

function PasswordForm({ user: before }: { user: string }) {
  const t = texts().signIn;
  const [user, setUser] = useState(before);
  const [password, setPassword] = useState('');
  const [isLong, setLong] = useState(false);
  const { fault, isBusy, submit } = useAttempt(async () => {
    try {
      await signIn({ user: user.trim(), password, ...(isLong && { hours: kWallHours }) });
    } finally {
      setPassword('');
    }
  });
  return (
    <form onSubmit={(event) => void submit(event)}>
      <label>{t.user}<input name="user" autocomplete="username" autocapitalize="none" required value={user} onInput={(e) => setUser(e.currentTarget.value)} /></label>
      <label>
        {t.password}
        <input type="password" name="password" autocomplete="current-password" required value={password} onInput={(e) => setPassword(e.currentTarget.value)} />
      </label>
      <label class="check">
        <input type="checkbox" checked={isLong} aria-describedby="long-hint" onChange={(e) => setLong(e.currentTarget.checked)} />
        {t.long}
      </label>
      <p id="long-hint" class="hint">{t.longHint}</p>
      {fault !== null && <p class="notice bad" role="alert">{fault}</p>}
      <button type="submit" class="primary" disabled={isBusy}>{t.submit}</button>
    </form>
  );
}

function FirstPasswordForm() {
  const t = texts().signIn;
  const [token, setToken] = useState('');
  const [password, setPassword] = useState('');
  const { fault, isBusy, submit } = useAttempt(async () => {
    if (!/^[\x21-\x7e]+$/.test(token.trim())) throw new ApiError(401, 'denied', t.notAToken); // no header could carry it
    await setFirstPassword(token.trim(), password);
  });
  return (
    <details>
      <summary class="button quiet">{t.first}</summary>
      <form onSubmit={(event) => void submit(event)}>
        <p class="hint">{t.firstHint}</p>
        <label>{t.token}<input type="password" name="token" autocomplete="off" required value={token} onInput={(e) => setToken(e.currentTarget.value)} /></label>
        <label>
          {t.newPassword}
          <input type="password" name="new-password" autocomplete="new-password" required minLength={10} value={password} onInput={(e) => setPassword(e.currentTarget.value)} />
        </label>
        {fault !== null && <p class="notice bad" role="alert">{fault}</p>}
        <button type="submit" disabled={isBusy}>{t.setPassword}</button>
      </form>
    </details>
  );
}

export function SignIn() {
  return (
    <main class="sign-in">
      <div class="sign-in-box">
        <h1>{texts().app.title}</h1>
        <PasswordForm user="" />
        <FirstPasswordForm />
      </div>
    </main>
  );
}

/// Over a view that stays as it is.
export function SignInAgain({ user }: { user: string }) {
  const t = texts().signIn;
  return (
    <dialog class="sign-in-box" aria-labelledby="sign-in-again" ref={(box) => { if (box?.isConnected && !box.open) box.showModal(); }} onCancel={(event) => event.preventDefault()} onClose={(event) => event.currentTarget.showModal()}>
      <h2 id="sign-in-again">{t.expired}</h2>
      <p>{t.expiredHint}</p>
      <PasswordForm user={user} />
    </dialog>
  );
}
