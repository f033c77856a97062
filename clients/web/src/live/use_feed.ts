// Draws a component again when its part of the feed has changed.
import { useEffect, useReducer } from 'preact/hooks';
import { feed, type Feed, type Topic } from './feed';

export function useFeed(...topics: Topic[]): Feed {
  const [, redraw] = useReducer((count: number) => count + 1, 0);
  useEffect(() => {
    const ends = topics.map((topic) => feed.on(topic, () => redraw(undefined)));
    return () => ends.forEach((end) => end());
  }, topics);
  return feed;
}
