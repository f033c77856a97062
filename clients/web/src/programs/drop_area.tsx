// Takes files that are dropped on the view, or chosen by a button.
import { useRef, useState } from 'preact/hooks';
import { texts } from '../texts/texts';

interface Props {
  /// What may be dropped here.
  label?: string;
  class?: string;
  onFiles: (files: File[]) => void;
}

export function DropArea({ label, onFiles, ...more }: Props) {
  const t = texts().programs;
  const input = useRef<HTMLInputElement>(null);
  const [isOver, setOver] = useState(false);
  const drop = (event: DragEvent) => {
    event.preventDefault();
    setOver(false);
    onFiles([...(event.dataTransfer?.files ?? [])]);
  };
  return (
    <div class={`drop ${more.class ?? ''} ${isOver ? 'over' : ''}`} data-testid="drop" onDragOver={(e) => { e.preventDefault(); setOver(true); }} onDragLeave={() => setOver(false)} onDrop={drop}>
      <span>{label ?? t.dropHere}</span>
      <button type="button" onClick={() => input.current?.click()}>{t.choose}</button>
      <input ref={input} type="file" multiple hidden aria-label={t.choose}
        onChange={(e) => { onFiles([...(e.currentTarget.files ?? [])]); e.currentTarget.value = ''; }} />
    </div>
  );
}
