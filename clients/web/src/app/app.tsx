// The frame around every view: who is signed in, which view is shown, and whether what it shows is current.
import { Component, type ComponentChildren } from 'preact';
import { useEffect, useState } from 'preact/hooks';
import { isSignedIn, onSession } from '../api/session';
import { Floor } from '../floor/floor';
import { feed } from '../live/feed';
import { texts } from '../texts/texts';
import { Header } from './header';
import { LinkBanner } from './link_banner';
import { parseRoute, type Route } from './route';
import { SignIn } from './sign_in';

function useRoute(): Route {
  const [route, setRoute] = useState(() => parseRoute(location.hash));
  useEffect(() => {
    const show = () => setRoute(parseRoute(location.hash));
    addEventListener('hashchange', show);
    return () => removeEventListener('hashchange', show);
  }, []);
  return route;
}

function useSession(): boolean {
  const [isIn, setIn] = useState(isSignedIn);
  useEffect(() => onSession(() => setIn(isSignedIn())), []);
  useEffect(() => {
    if (isIn) feed.begin();
    return () => feed.end();
  }, [isIn]);
  return isIn;
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
  reports: () => import('../reports/reports'),
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
  const isIn = useSession();
  const [, redraw] = useState(0); // for another language
  if (!isIn) return <SignIn />;
  const isWall = route.view === 'floor' && route.query.has('wall');
  return (
    <>
      {!isWall && <Header route={route} onLanguage={() => redraw((count) => count + 1)} />}
      <LinkBanner />
      <main id="content" tabIndex={-1} class={isWall ? 'wall' : ''}>
        <Guard name={location.hash}><View route={route} /></Guard>
      </main>
    </>
  );
}
