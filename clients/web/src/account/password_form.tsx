// Changes the own password. The page forgets both as soon as they are sent.
import { useState } from 'preact/hooks';
import { pathOf, send } from '../api/request';
import { CommandFault, useCommand } from '../parts/command';
import { texts } from '../texts/texts';

export const kMinPassword = 10;

export function PasswordForm({ user }: { user: string }) {
  const t = texts().account;
  const command = useCommand();
  const [current, setCurrent] = useState('');
  const [password, setPassword] = useState('');
  const [repeated, setRepeated] = useState('');
  const [isDone, setDone] = useState(false);
  const submit = async (event: Event) => {
    event.preventDefault();
    const isChanged = await command.send(async () => {
      if (password !== repeated) throw new Error(t.notTheSame);
      await send('PUT', pathOf('users', user, 'password'), { json: { password, current } });
    });
    setDone(isChanged);
    if (isChanged) for (const clear of [setCurrent, setPassword, setRepeated]) clear('');
  };
  const field = (label: string, value: string, set: (text: string) => void, autocomplete: string, minLength: number) => (
    <label>
      {label}
      <input type="password" required minLength={minLength} autocomplete={autocomplete} value={value} onInput={(e) => { set(e.currentTarget.value); setDone(false); }} />
    </label>
  );
  return (
    <section class="panel" aria-labelledby="password">
      <h2 id="password">{t.password}</h2>
      <form onSubmit={(event) => void submit(event)}>
        <input class="visually-hidden" type="text" autocomplete="username" value={user} readOnly tabIndex={-1} aria-hidden="true" />
        {field(t.current, current, setCurrent, 'current-password', 0)}
        {field(t.newPassword, password, setPassword, 'new-password', kMinPassword)}
        {field(t.repeat, repeated, setRepeated, 'new-password', kMinPassword)}
        <p class="buttons"><button type="submit" class="primary" disabled={command.isBusy}>{t.changePassword}</button></p>
        {isDone && <p class="notice" role="status">{t.passwordChanged}</p>}
        <CommandFault command={command} />
      </form>
    </section>
  );
}
