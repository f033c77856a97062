// Steps through a list that the server gives in pages, the latest first.
import { texts } from '../texts/texts';

interface Props {
  offset: number;
  /// Of a whole page.
  size: number;
  /// On the page that is shown.
  count: number;
  onOffset: (offset: number) => void;
}

export function Pages({ offset, size, count, onOffset }: Props) {
  const t = texts().reports;
  return (
    <p class="buttons">
      <button type="button" disabled={offset === 0} onClick={() => onOffset(Math.max(0, offset - size))}>{t.newer}</button>
      <button type="button" disabled={count < size} onClick={() => onOffset(offset + size)}>{t.older}</button>
    </p>
  );
}
