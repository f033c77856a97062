// The tokens and sessions of a user: made, shown once, revoked.
import { useState } from 'preact/hooks';
import type { IssuedToken, Token, Tokens as TokenList } from '../../generated/api';
import { get, pathOf, send } from '../api/request';
import { useSessionState } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { Disclosure } from '../parts/disclosure';
import { GroupChoice } from '../parts/group_choice';
import { Loading } from '../parts/loading';
import { RoleSelect } from '../parts/role_select';
import { Secret } from '../parts/secret';
import { SureButton } from '../parts/sure_button';
import { useLoaded } from '../parts/use_loaded';
import { dateTimeText, texts } from '../texts/texts';

const kUsualDays = 90;
const kMaxDays = 730;
const kOrder: Array<Token['kind']> = ['token', 'login', 'page'];

function NewToken({ user, onMade }: { user: string; onMade: (token: IssuedToken) => void }) {
  const t = texts().account;
  const command = useCommand();
  const [name, setName] = useState('');
  const [role, setRole] = useState('');
  const [groups, setGroups] = useState<string[]>([]);
  const [days, setDays] = useState(kUsualDays);
  const make = async (event: Event) => {
    event.preventDefault();
    const json = { name, days, ...(role !== '' && { role }), ...(groups.length > 0 && { groups }) };
    await command.send(async () => onMade(await send<IssuedToken>('POST', pathOf('users', user, 'tokens'), { json })));
  };
  return (
    <form onSubmit={(event) => void make(event)}>
      <label>{t.name}<input required maxLength={64} autocomplete="off" autocapitalize="none" value={name} onInput={(e) => setName(e.currentTarget.value)} /></label>
      <RoleSelect label={t.role} none={t.ownRole} value={role} onChange={setRole} />
      <GroupChoice legend={`${t.machineGroups} (${t.usersGroups})`} chosen={groups} onChange={setGroups} />
      <label>{t.days}<input type="number" required min={1} max={kMaxDays} value={days} onInput={(e) => setDays(e.currentTarget.valueAsNumber)} /></label>
      <p class="buttons"><button type="submit" class="primary" disabled={command.isBusy}>{t.addToken}</button></p>
      <CommandFault command={command} />
    </form>
  );
}

function TokenRow({ token, isOwn, onRevoke }: { token: Token; isOwn: boolean; onRevoke: () => void }) {
  const t = texts().account;
  return (
    <tr>
      <th scope="row">{token.name}{isOwn && <span class="muted"> ({t.thisSession})</span>}</th>
      <td>{t.kinds[token.kind]}</td>
      <td>{texts().session.roles[token.role]}</td>
      <td>{token.groups === null ? t.usersGroups : token.groups.join(', ')}</td>
      <td>{token.expires === null ? t.never : dateTimeText(token.expires)}</td>
      <td>{token.used === null ? t.never : `${dateTimeText(token.used)}${token.used_from !== null ? `, ${token.used_from}` : ''}`}</td>
      <td>{!isOwn && <SureButton class="danger" label={t.revoke} question={t.revokeSure(token.name)} onSure={onRevoke} />}</td>
    </tr>
  );
}

export function Tokens({ user, title }: { user: string; title: string }) {
  const t = texts().account;
  const state = useSessionState();
  const command = useCommand();
  const [issued, setIssued] = useState<IssuedToken | null>(null);
  const tokens = useLoaded((signal) => get<TokenList>(pathOf('users', user, 'tokens'), {}, signal), [user]);
  const list = [...(tokens.value?.tokens ?? [])].sort((a, b) => kOrder.indexOf(a.kind) - kOrder.indexOf(b.kind) || b.created.localeCompare(a.created));
  const isOwn = (token: Token) => 'session' in state && state.session.user === user && state.session.credential === token.name;
  const revoke = async (name: string) => {
    if (await command.send(() => send('DELETE', pathOf('users', user, 'tokens', name)))) tokens.reload();
  };
  const take = (token: IssuedToken) => {
    setIssued(token);
    tokens.reload();
  };
  return (
    <section class="panel" aria-labelledby="tokens">
      <h2 id="tokens">{title}</h2>
      <p class="hint">{t.tokensHint}</p>
      <Loading of={tokens} />
      {tokens.value && list.length === 0 && <p class="muted">{t.noTokens}</p>}
      {list.length > 0 && (
        <div class="scroll" tabIndex={0} role="group" aria-labelledby="tokens">
          <table>
            <thead><tr>{[t.name, t.kind, t.role, t.machineGroups, t.expires, t.used, ''].map((name, i) => (name === '' ? <td key={i} /> : <th scope="col" key={i}>{name}</th>))}</tr></thead>
            <tbody>{list.map((token) => <TokenRow key={token.name} token={token} isOwn={isOwn(token)} onRevoke={() => void revoke(token.name)} />)}</tbody>
          </table>
        </div>
      )}
      <CommandFault command={command} />
      {issued ? <Secret title={t.issued(issued.name)} secret={issued.secret} onDone={() => setIssued(null)} /> : (
        <Disclosure summary={t.addToken}><NewToken user={user} onMade={take} /></Disclosure>
      )}
    </section>
  );
}
