// A button for what is not to happen by a stray touch: pressed once it says what it will do, pressed again it does it.
import { useEffect, useState } from 'preact/hooks';

const kArmedMs = 6000;

interface Props {
  label: string;
  /// What the second press does, with names.
  question: string;
  class?: string;
  disabled?: boolean;
  onSure: () => void;
}

export function SureButton({ label, question, disabled, onSure, ...more }: Props) {
  const [isArmed, setArmed] = useState(false);
  useEffect(() => {
    if (!isArmed) return undefined;
    const timer = setTimeout(() => setArmed(false), kArmedMs);
    return () => clearTimeout(timer);
  }, [isArmed]);
  // Another question is another decision.
  useEffect(() => setArmed(false), [question]);
  const press = () => {
    setArmed(!isArmed);
    if (isArmed) onSure();
  };
  return (
    <button type="button" class={`${more.class ?? ''} ${isArmed ? 'armed' : ''}`} disabled={disabled ?? false} aria-live="polite" onClick={press}>
      {isArmed ? question : label}
    </button>
  );
}
