// State that belongs to what is chosen: with another choice it is as at the beginning, in the same drawing. An effect that reset it would come one drawing
// late, and what depends on it would be loaded twice.
import { useState } from 'preact/hooks';

/// `key`: a text for each choice.
export function useKept<T>(key: string, initial: T): [T, (value: T) => void] {
  const [kept, keep] = useState({ key, value: initial });
  return [kept.key === key ? kept.value : initial, (value) => keep({ key, value })];
}

/// The page of a list that is shown; of another list the first.
export function useOffset(...choices: string[]): [number, (offset: number) => void] {
  return useKept(JSON.stringify(choices), 0);
}
