// Sends what changes something, once, and shows what came of it.
import { useState } from 'preact/hooks';
import { ApiError } from '../api/request';
import { texts } from '../texts/texts';

export interface Command {
  isBusy: boolean;
  fault: string | null;
  /// True: it was carried out. A second one is not sent while the first has no answer.
  send(action: () => Promise<unknown>): Promise<boolean>;
  dismiss(): void;
}

/// What a failure means to the one who gave a command: without an answer it may have been carried out.
export function faultText(failure: unknown, isCommand: boolean): string {
  if (!(failure instanceof ApiError)) return failure instanceof Error ? failure.message : String(failure);
  if (failure.status === 401) return isCommand ? texts().errors.notSentAsSignedOut : texts().errors.signedOut;
  if (failure.status === 0) return isCommand ? texts().errors.unknownOutcome : texts().errors.unreachable;
  return failure.message;
}

export function useCommand(): Command {
  const [isBusy, setBusy] = useState(false);
  const [fault, setFault] = useState<string | null>(null);
  const send = async (action: () => Promise<unknown>) => {
    if (isBusy) return false;
    setBusy(true);
    setFault(null);
    try {
      await action();
      return true;
    } catch (failure) {
      setFault(faultText(failure, true));
      return false;
    } finally {
      setBusy(false);
    }
  };
  return { isBusy, fault, send, dismiss: () => setFault(null) };
}

export function CommandFault({ command }: { command: Command }) {
  if (command.fault === null) return null;
  return (
    <div class="notice bad with-button" role="alert">
      <span>{command.fault}</span>
      <button type="button" onClick={command.dismiss}>{texts().errors.dismiss}</button>
    </div>
  );
}
