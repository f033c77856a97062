// Whether an element is on screen or near it. Of a thousand cards a screen shows thirty: the others need not follow every change.
import { useEffect, useRef, useState } from 'preact/hooks';

const kMargin = '400px';

type Listener = (isNear: boolean) => void;
const listeners = new Map<Element, Listener>();
let observer: IntersectionObserver | null = null;

/// One observer for all of them.
function observe(element: Element, listener: Listener): () => void {
  observer ??= new IntersectionObserver((entries) => {
    for (const entry of entries) listeners.get(entry.target)?.(entry.isIntersecting);
  }, { rootMargin: kMargin });
  listeners.set(element, listener);
  observer.observe(element);
  return () => {
    listeners.delete(element);
    observer?.unobserve(element);
  };
}

export function useNear<E extends Element>() {
  const ref = useRef<E>(null);
  const [isNear, setNear] = useState(false);
  useEffect(() => (ref.current ? observe(ref.current, setNear) : undefined), []);
  return { ref, isNear };
}
