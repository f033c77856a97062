// Draws a component again when its part of the feed has changed.
import { useEffect, useReducer } from 'preact/hooks';
import { feed, type Feed, type Topic } from './feed';

/// What is not on screen is kept nearly current: for a screen reader, and for the moment in which it is scrolled to.
const kFarMs = 10_000;

/// Together with what is on screen, when a notification comes after the time is up: a drawing of its own for each would cost the whole page one. The timer is
/// for what changes no more.
function followNowAndThen(topic: Topic, redraw: () => void): () => void {
  let timer: ReturnType<typeof setTimeout> | null = null;
  let due = performance.now() + kFarMs * Math.random();
  const draw = () => {
    if (timer !== null) clearTimeout(timer);
    timer = null;
    due = performance.now() + kFarMs * (0.5 + Math.random());
    redraw();
  };
  const end = feed.on(topic, () => {
    if (performance.now() >= due) draw();
    else timer ??= setTimeout(draw, 2 * kFarMs);
  });
  return () => { end(); if (timer !== null) clearTimeout(timer); };
}

/// Of one part: at once while it is near, otherwise now and then.
export function useFeedNear(topic: Topic, isNear: boolean): Feed {
  const [, redraw] = useReducer((count: number) => count + 1, 0);
  useEffect(() => {
    if (isNear) {
      redraw(undefined); // what has changed while it was far
      return feed.on(topic, () => redraw(undefined));
    }
    return followNowAndThen(topic, () => redraw(undefined));
  }, [topic, isNear]);
  return feed;
}

export function useFeed(...topics: Topic[]): Feed {
  const [, redraw] = useReducer((count: number) => count + 1, 0);
  const drawn = feed.notified;
  useEffect(() => {
    if (feed.notified !== drawn) redraw(undefined); // what came between the first drawing and now
    const ends = topics.map((topic) => feed.on(topic, () => redraw(undefined)));
    return () => ends.forEach((end) => end());
  }, topics);
  return feed;
}
