// The users: added, given a role and groups of machines, locked, removed; their passwords and tokens.
import { useState } from 'preact/hooks';
import type { User, Users as UserList } from '../../generated/api';
import { Tokens } from '../account/tokens';
import { kMinPassword } from '../account/password_form';
import { get, pathOf, send } from '../api/request';
import { addressOf } from '../app/route';
import { CommandFault, useCommand } from '../parts/command';
import { Disclosure } from '../parts/disclosure';
import { GroupChoice } from '../parts/group_choice';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { RoleSelect } from '../parts/role_select';
import { SureButton } from '../parts/sure_button';
import { useLoaded } from '../parts/use_loaded';
import { dateTimeText, texts } from '../texts/texts';

function PasswordField({ label, value, isRequired, onChange }: { label: string; value: string; isRequired: boolean; onChange: (text: string) => void }) {
  return (
    <label>
      {label}
      <input type="password" autocomplete="new-password" required={isRequired} minLength={kMinPassword} value={value} onInput={(e) => onChange(e.currentTarget.value)} />
    </label>
  );
}

function NewUser({ onAdded }: { onAdded: () => void }) {
  const t = texts().users;
  const command = useCommand();
  const [name, setName] = useState('');
  const [role, setRole] = useState('operator');
  const [groups, setGroups] = useState<string[]>([]);
  const [password, setPassword] = useState('');
  const add = async (event: Event) => {
    event.preventDefault();
    const json = { name, role, groups, ...(password !== '' && { password }) };
    if (await command.send(() => send('POST', pathOf('users'), { json }))) onAdded();
  };
  return (
    <form class="panel" onSubmit={(event) => void add(event)}>
      <label>{t.name}<input required maxLength={64} autocomplete="off" autocapitalize="none" value={name} onInput={(e) => setName(e.currentTarget.value)} /></label>
      <RoleSelect label={t.role} value={role} onChange={setRole} />
      <GroupChoice legend={t.groups} chosen={groups} onChange={setGroups} />
      <PasswordField label={t.password} value={password} isRequired={false} onChange={setPassword} />
      <p class="buttons"><button type="submit" class="primary" disabled={command.isBusy}>{t.add}</button></p>
      <CommandFault command={command} />
    </form>
  );
}

function Rights({ user, onChanged }: { user: User; onChanged: () => void }) {
  const t = texts().users;
  const command = useCommand();
  const [role, setRole] = useState<string>(user.role);
  const [groups, setGroups] = useState(user.groups);
  const [isStored, setStored] = useState(false);
  const change = async (json: object) => {
    const isDone = await command.send(() => send('PUT', pathOf('users', user.name), { json }));
    setStored(isDone);
    if (isDone) onChanged();
  };
  const remove = async () => {
    if (!(await command.send(() => send('DELETE', pathOf('users', user.name))))) return;
    location.hash = addressOf('administration', ['users']);
    onChanged();
  };
  return (
    <section class="panel" aria-labelledby="rights">
      <h2 id="rights">{user.name}</h2>
      <RoleSelect label={t.role} value={role} onChange={setRole} />
      <GroupChoice legend={t.groups} chosen={groups} onChange={setGroups} />
      <p class="buttons">
        <button type="button" class="primary" disabled={command.isBusy} onClick={() => void change({ role, groups })}>{t.store}</button>
        {user.locked
          ? <button type="button" disabled={command.isBusy} onClick={() => void change({ locked: false })}>{t.unlock}</button>
          : <SureButton class="danger" label={t.lock} question={t.lockSure(user.name)} disabled={command.isBusy} onSure={() => void change({ locked: true })} />}
        <SureButton class="danger" label={t.remove} question={t.removeSure(user.name)} disabled={command.isBusy} onSure={() => void remove()} />
      </p>
      {isStored && <p class="notice" role="status">{t.stored}</p>}
      <CommandFault command={command} />
    </section>
  );
}

function Password({ user, onChanged }: { user: User; onChanged: () => void }) {
  const t = texts().users;
  const command = useCommand();
  const [password, setPassword] = useState('');
  const set = async (event: Event) => {
    event.preventDefault();
    if (!(await command.send(() => send('PUT', pathOf('users', user.name, 'password'), { json: { password } })))) return;
    setPassword('');
    onChanged();
  };
  return (
    <form class="panel" onSubmit={(event) => void set(event)}>
      <PasswordField label={t.newPassword} value={password} isRequired onChange={setPassword} />
      <p class="buttons"><button type="submit" disabled={command.isBusy}>{t.setPassword}</button></p>
      <CommandFault command={command} />
    </form>
  );
}

function UserTable({ users }: { users: User[] }) {
  const t = texts().users;
  return (
    <div class="scroll" tabIndex={0} role="group" aria-labelledby="users">
      <table class="data">
        <Heads of={[t.name, t.role, t.groups, t.state, t.signedIn]} />
        <tbody>
          {users.map((user) => (
            <tr key={user.name}>
              <th scope="row"><a class="target" href={addressOf('administration', ['users', user.name])} aria-label={t.manageUser(user.name)}>{user.name}</a></th>
              <td>{texts().session.roles[user.role]}</td>
              <td>{user.groups.join(', ') || t.noGroups}</td>
              <td>{user.locked ? <span class="pill alarm">{t.locked}</span> : t.active}{!user.has_password && `, ${t.noPassword}`}</td>
              <td>{user.signed_in === null ? '–' : dateTimeText(user.signed_in)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

/// `chosen`: the user whose rights, password and tokens are shown (#/administration/users/anna).
export function Users({ chosen }: { chosen: string | undefined }) {
  const t = texts().users;
  const users = useLoaded((signal) => get<UserList>(pathOf('users'), {}, signal), []);
  const [count, setCount] = useState(0); // an empty form after each user
  const list = users.value?.users ?? [];
  const user = list.find((row) => row.name === chosen);
  return (
    <section aria-labelledby="users">
      <h2 id="users">{t.title}</h2>
      <Loading of={users} />
      {users.value && <UserTable users={list} />}
      {user && (
        <div class="account-columns" key={user.name}>
          <div><Rights user={user} onChanged={users.reload} /><Password user={user} onChanged={users.reload} /></div>
          <Tokens user={user.name} title={texts().account.tokensOf(user.name)} />
        </div>
      )}
      <Disclosure summary={t.add}><NewUser key={count} onAdded={() => { setCount(count + 1); users.reload(); }} /></Disclosure>
    </section>
  );
}
