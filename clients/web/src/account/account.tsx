// What concerns the user who is signed in: the session, the password, the tokens.
import { useSessionState } from '../parts/allowed';
import { dateTimeText, texts } from '../texts/texts';
import { PasswordForm } from './password_form';
import { Tokens } from './tokens';

export default function AccountView() {
  const state = useSessionState();
  if (!('session' in state)) return null;
  const { user, role, groups, expires } = state.session;
  const t = texts().account;
  const machines = groups.includes('all') || role === 'administrator' ? t.allMachines : groups.length === 0 ? t.noGroups : t.groups(groups.join(', '));
  return (
    <>
      <h1>{t.title}</h1>
      <p>{t.signedInAs(user, texts().session.roles[role])} {machines} {expires !== null && t.until(dateTimeText(expires))}</p>
      <div class="account-columns">
        <PasswordForm user={user} />
        <Tokens user={user} title={t.tokens} />
      </div>
    </>
  );
}
