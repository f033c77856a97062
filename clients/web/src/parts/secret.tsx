// A secret that the server shows once: in memory as long as it is on screen, and nowhere else.
import { useState } from 'preact/hooks';
import { texts } from '../texts/texts';

export function Secret({ title, secret, onDone }: { title: string; secret: string; onDone: () => void }) {
  const t = texts().account;
  const [isCopied, setCopied] = useState(false);
  return (
    <div class="notice warn" role="status">
      <p><b>{title}</b></p>
      <p class="mono secret">{secret}</p>
      <p class="buttons">
        <button type="button" onClick={() => void navigator.clipboard?.writeText(secret).then(() => setCopied(true), () => {})}>{isCopied ? t.copied : t.copy}</button>
        <button type="button" class="primary" onClick={onDone}>{t.done}</button>
      </p>
    </div>
  );
}
