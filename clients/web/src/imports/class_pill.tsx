// The class of an edit: a word on a color.
import type { Import } from '../../generated/api';
import { texts } from '../texts/texts';
import { classOf, toneOf } from './class_text';

export function ClassPill({ import_ }: { import_: Import }) {
  const t = texts().imports;
  const shown = classOf(import_);
  const word = shown === 'comparing' ? t.comparing : shown === 'unknown' ? t.unknown : t.classes[shown];
  return <span class={`pill ${toneOf(shown)}`}>{word}</span>;
}
