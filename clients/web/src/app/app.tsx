// The frame around every view: who is signed in, which view is shown, and whether what it shows is current.
import { Component, type ComponentChildren } from 'preact';
import { useEffect, useMemo, useState } from 'preact/hooks';
import { beginSession, refreshSession, type SessionState } from '../api/session';
import { Floor } from '../floor/floor';
import { feed } from '../live/feed';
import { useSessionState } from '../parts/allowed';
import { texts } from '../texts/texts';
import { Header } from './header';
import { LinkBanner } from './link_banner';
import { parseRoute, type Route } from './route';
import { SignIn, SignInAgain } from './sign_in';

function useRoute(): Route {
  const [hash, setHash] = useState(location.hash);
  useEffect(() => {
    const show = () => setHash(location.hash);
    addEventListener('hashchange', show);
    show(); // an effect runs after the first picture: the address may be another by then
    return () => removeEventListener('hashchange', show);
  }, []);
  return useMemo(() => parseRoute(hash), [hash]);
}

/// The feed follows the session: it reads while someone is signed in, and keeps what it knows while a session is renewed.
function useSession(): SessionState {
  const state = useSessionState();
  useEffect(() => void beginSession(), []);
  useEffect(() => {
    if (state.is === 'in') feed.begin();
    if (state.is === 'expired') feed.pause();
    if (state.is === 'out') feed.end();
  }, [state.is]);
  useEffect(() => {
    const refresh = () => { if (!document.hidden && state.is === 'in') refreshSession().catch(() => {}); };
    document.addEventListener('visibilitychange', refresh);
    return () => document.removeEventListener('visibilitychange', refresh);
  }, [state.is]);
  return state;
}

/// A defect in one view must not take the others away.
class Guard extends Component<{ name: string; children: ComponentChildren }, { failure: string | null }> {
  override state = { failure: null as string | null };
  static getDerivedStateFromError(failure: unknown) {
    return { failure: String(failure) };
  }
  override componentDidUpdate(before: { name: string }) {
    if (before.name !== this.props.name && this.state.failure) this.setState({ failure: null });
  }
  override render() {
    return this.state.failure ? <p class="notice bad" role="alert">{this.state.failure}</p> : this.props.children;
  }
}

type LaterView = (props: { path: string[]; query: URLSearchParams }) => ComponentChildren;

/// The floor comes with the page; the rest is loaded when it is first asked for.
const kLater: { [view: string]: () => Promise<{ default: LaterView }> } = {
  machine: () => import('../machine/machine'),
  programs: () => import('../programs/programs'),
  imports: () => import('../imports/imports'),
  reports: () => import('../reports/reports'),
  measurements: () => import('../measurements/measurements'),
  corrections: () => import('../corrections/corrections'),
  templates: () => import('../templates/templates'),
  path: () => import('../path/path'),
  compare: () => import('../compare/compare'),
  account: () => import('../account/account'),
  administration: () => import('../administration/administration'),
};

function Later({ load, route }: { load: () => Promise<{ default: LaterView }>; route: Route }) {
  const [Shown, show] = useState<LaterView | null>(null);
  const [isGone, setGone] = useState(false);
  useEffect(() => {
    load().then((module) => show(() => module.default), () => setGone(true));
  }, []);
  const t = texts().app;
  if (isGone) {
    return <p class="notice warn">{t.newVersion} <button type="button" onClick={() => location.reload()}>{t.reload}</button></p>;
  }
  return Shown ? <Shown path={route.path} query={route.query} /> : <p class="muted" role="status">{t.loading}</p>;
}

function View({ route }: { route: Route }) {
  if (route.view === 'floor') return <Floor query={route.query} />;
  const load = Object.hasOwn(kLater, route.view) ? kLater[route.view] : undefined;
  return load ? <Later key={route.view} load={load} route={route} /> : <p class="notice">{texts().app.notFound}</p>;
}

export function App() {
  const route = useRoute();
  const state = useSession();
  const [, redraw] = useState(0); // for another language
  if (state.is === 'unknown') return <p class="banner connecting" role="status">{texts().link.connecting}</p>;
  if (state.is === 'out') return <SignIn />;
  const isWall = route.view === 'floor' && route.query.has('wall');
  return (
    <>
      {!isWall && <Header route={route} onLanguage={() => redraw((count) => count + 1)} />}
      <LinkBanner />
      <main id="content" tabIndex={-1} class={isWall ? 'wall' : ''}>
        <Guard name={location.hash}><View key={state.session.user} route={route} /></Guard>
      </main>
      {state.is === 'expired' && <SignInAgain user={state.session.user} />}
    </>
  );
}
