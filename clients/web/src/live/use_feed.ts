// Draws a component again when its part of the feed has changed.
import { useEffect, useReducer } from 'preact/hooks';
import { feed, type Feed, type Topic } from './feed';

/// What is not on screen is kept nearly current: for a screen reader, and for the moment in which it is scrolled to.
const kFarMs = 5000;

/// Of one part: at once while it is near, otherwise now and then.
export function useFeedNear(topic: Topic, isNear: boolean): Feed {
  const [, redraw] = useReducer((count: number) => count + 1, 0);
  useEffect(() => {
    if (isNear) {
      redraw(undefined); // what has changed while it was far
      return feed.on(topic, () => redraw(undefined));
    }
    let timer: ReturnType<typeof setTimeout> | null = null;
    const end = feed.on(topic, () => {
      timer ??= setTimeout(() => { timer = null; redraw(undefined); }, kFarMs * (0.5 + Math.random()));
    });
    return () => { end(); if (timer !== null) clearTimeout(timer); };
  }, [topic, isNear]);
  return feed;
}

export function useFeed(...topics: Topic[]): Feed {
  const [, redraw] = useReducer((count: number) => count + 1, 0);
  useEffect(() => {
    const ends = topics.map((topic) => feed.on(topic, () => redraw(undefined)));
    return () => ends.forEach((end) => end());
  }, topics);
  return feed;
}
