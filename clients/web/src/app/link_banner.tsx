// Says that what the page shows is old, and since when. While it is, the document is marked, so that every value looks old.
import { useEffect } from 'preact/hooks';
import { useFeed } from '../live/use_feed';
import { texts, timeText } from '../texts/texts';

export function LinkBanner() {
  const { link } = useFeed('link');
  useEffect(() => {
    document.documentElement.classList.toggle('old', link.state === 'lost' || link.state === 'signedOut');
  }, [link.state]);
  const t = texts().link;
  return (
    <div role="status" class={`banner ${link.state}`}>
      {link.state === 'lost' && t.lost(timeText(link.since))}
      {link.state === 'signedOut' && t.signedOut(timeText(link.since))}
      {link.state === 'connecting' && t.connecting}
    </div>
  );
}
