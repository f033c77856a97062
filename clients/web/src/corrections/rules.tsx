// The rules by which a machine's corrections are proposed: read, changed by who may approve, and evaluated now, with the reasons in words.
import { useState } from 'preact/hooks';
import type { OffsetEvaluation, OffsetRules } from '../../generated/api';
import { getIfThere, pathOf, send } from '../api/request';
import { Allowed } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { Loading } from '../parts/loading';
import { useLoaded } from '../parts/use_loaded';
import { dateTimeText, texts } from '../texts/texts';
import { valueText } from './steps';

const kRows = 14;
const kMaxText = 65_536;

/// null: the machine has none.
async function loadRules(machine: string, signal: AbortSignal): Promise<{ rules: OffsetRules | null }> {
  return { rules: await getIfThere<OffsetRules>(pathOf('machines', machine, 'offset-rules'), {}, signal) };
}

function RulesText({ machine, stored, onStored }: { machine: string; stored: string; onStored: () => void }) {
  const t = texts().corrections;
  const command = useCommand();
  const [text, setText] = useState(stored);
  const store = async () => {
    if (await command.send(() => send('PUT', pathOf('machines', machine, 'offset-rules'), { raw: text }))) onStored();
  };
  return (
    <Allowed to="approve" machine={machine}>
      <label>{t.rulesText}<textarea rows={kRows} maxLength={kMaxText} spellcheck={false} value={text} onInput={(e) => setText(e.currentTarget.value)} /></label>
      <p class="buttons"><button type="button" class="primary" disabled={text === stored || command.isBusy} onClick={() => void store()}>{t.storeRules}</button></p>
      <CommandFault command={command} />
    </Allowed>
  );
}

function Evaluation({ machine }: { machine: string }) {
  const t = texts().corrections;
  const command = useCommand();
  const [result, setResult] = useState<OffsetEvaluation | null>(null);
  const evaluate = () => command.send(async () => setResult(await send<OffsetEvaluation>('POST', pathOf('machines', machine, 'offsets', 'evaluation'))));
  return (
    <>
      <Allowed to="set_up" machine={machine}><p class="buttons"><button type="button" disabled={command.isBusy} onClick={() => void evaluate()}>{t.evaluate}</button></p></Allowed>
      <CommandFault command={command} />
      {result && (
        <div role="status"><ul class="list">
          {result.rules.map((rule) => (
            <li key={rule.rule} class="notice">
              <b>{rule.rule}</b> {rule.target} {valueText(rule.value, rule.unit)}{rule.proposal && <> → <b>{valueText(rule.proposal.new_value, rule.unit)}</b></>}
              <ul class="reasons">{rule.reasons.map((reason) => <li key={reason}>{reason}</li>)}</ul>
            </li>
          ))}
        </ul></div>
      )}
    </>
  );
}

export function Rules({ machine }: { machine: string }) {
  const t = texts().corrections;
  const loaded = useLoaded((signal) => loadRules(machine, signal), [machine]);
  const rules = loaded.value?.rules ?? null;
  return (
    <section class="panel rules" aria-labelledby="rules">
      <h2 id="rules">{t.rules}</h2>
      <Loading of={loaded} />
      {loaded.value && (
        <>
          <p class="hint">{rules ? t.rulesVersion(rules.version, rules.author, dateTimeText(rules.created)) : t.noRules}</p>
          {rules && <Evaluation machine={machine} />}
          <details>
            <summary class="button">{t.changeRules}</summary>
            <RulesText key={rules?.version ?? 0} machine={machine} stored={rules?.text ?? ''} onStored={loaded.reload} />
          </details>
        </>
      )}
    </section>
  );
}
