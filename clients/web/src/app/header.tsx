// The bar at the top: the views, the link, and what this browser's user has chosen.
import { signOut } from '../api/session';
import { CommandFault, useCommand } from '../parts/command';
import { useSessionState } from '../parts/allowed';
import { useFeed } from '../live/use_feed';
import { languages, loadTexts, texts, type Language } from '../texts/texts';
import { keepPreferences, preferences, showTheme, type Theme } from './preferences';
import { addressOf, type Route } from './route';

/// The views of the bar, and those that belong to one of them.
const kViews = ['floor', 'programs', 'imports', 'reports', 'administration'] as const;
const kParents: { [view: string]: string } = { machine: 'floor', path: 'programs', compare: 'programs', measurements: 'reports', corrections: 'reports', templates: 'reports' };

function skip(event: Event): void {
  event.preventDefault();
  document.getElementById('content')?.focus();
}

function Settings({ onLanguage }: { onLanguage: () => void }) {
  const t = texts().app;
  const command = useCommand();
  const chooseLanguage = async (language: Language) => {
    await loadTexts(language);
    keepPreferences({ language });
    onLanguage();
  };
  const chooseTheme = (theme: Theme) => {
    keepPreferences({ theme });
    showTheme(theme);
  };
  return (
    <details class="settings">
      <summary class="button">{t.settings}</summary>
      <div class="panel">
        <label>
          {t.language}
          <select value={preferences.language} onChange={(e) => void chooseLanguage(e.currentTarget.value as Language)}>
            {Object.entries(languages).map(([key, { name }]) => <option key={key} value={key} lang={key}>{name}</option>)}
          </select>
        </label>
        <label>
          {t.theme}
          <select value={preferences.theme} onChange={(e) => chooseTheme(e.currentTarget.value as Theme)}>
            {Object.entries(t.themes).map(([key, name]) => <option key={key} value={key}>{name}</option>)}
          </select>
        </label>
        <button type="button" disabled={command.isBusy} onClick={() => void command.send(signOut)}>{t.signOut}</button>
        <CommandFault command={command} />
      </div>
    </details>
  );
}

function WhoIsSignedIn({ isShown }: { isShown: boolean }) {
  const state = useSessionState();
  if (!('session' in state)) return null;
  const { user, role } = state.session;
  return <a class="who" href={addressOf('account')} aria-current={isShown ? 'page' : undefined}>{user} <span>{texts().session.roles[role]}</span></a>;
}

function LinkState() {
  const { link } = useFeed('link');
  const t = texts().link;
  return <span class={`link ${link.state}`}>{link.state === 'live' ? t.live : link.state === 'connecting' ? '…' : t.old}</span>;
}

/// How many programs from machines, or corrections, wait for a decision.
function Waiting({ view }: { view: 'imports' | 'reports' }) {
  const { imports, offsets } = useFeed('imports', 'offsets');
  const { size } = view === 'imports' ? imports : offsets;
  return size === 0 ? null : <span class="count"><span aria-hidden="true">{size}</span><span class="visually-hidden">{texts().app.waiting(size)}</span></span>;
}

export function Header({ route, onLanguage }: { route: Route; onLanguage: () => void }) {
  const t = texts().app;
  const shown = kParents[route.view] ?? route.view;
  return (
    <header class="bar">
      <a class="skip" href="#content" onClick={skip}>{t.skip}</a>
      <span class="name">{t.title}</span>
      <nav aria-label={t.menu}>
        {kViews.map((view) => (
          <a key={view} href={addressOf(view)} aria-current={view === shown ? 'page' : undefined}>{t.views[view]}{(view === 'imports' || view === 'reports') && <Waiting view={view} />}</a>
        ))}
      </nav>
      <LinkState />
      <WhoIsSignedIn isShown={shown === 'account'} />
      <Settings onLanguage={onLanguage} />
    </header>
  );
}
