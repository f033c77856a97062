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

function View({ route }: { route: Route }) {
  switch (route.view) {
    case 'floor': return <Floor query={route.query} />;
    default: return <p class="notice">{texts().app.notFound}</p>;
  }
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
