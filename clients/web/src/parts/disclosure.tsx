// What is drawn, and loaded, only once it was opened; what was typed in it stays while it is closed again.
import type { ComponentChildren } from 'preact';
import { useState } from 'preact/hooks';

interface Props {
  summary: string;
  class?: string;
  isOpen?: boolean;
  children: ComponentChildren;
}

export function Disclosure({ summary, isOpen = false, children, ...more }: Props) {
  const [wasOpen, setOpen] = useState(isOpen);
  return (
    <details {...more} open={isOpen} onToggle={(e) => { if (e.currentTarget.open) setOpen(true); }}>
      <summary class="button">{summary}</summary>
      {(wasOpen || isOpen) && children}
    </details>
  );
}
