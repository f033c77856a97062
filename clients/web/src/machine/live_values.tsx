// What the variables, offsets and outputs of the control are now, asked of its gateway again and again while the view is shown.
import { useEffect, useState } from 'preact/hooks';
import type { Values } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { Loading } from '../parts/loading';
import { useLoaded } from '../parts/use_loaded';
import { texts } from '../texts/texts';
import { usedValues } from './screen';

const kIntervalMs = 2000;

/// With the words that the control hands on; of an older gateway without.
const functionTexts = (values: Values) => (values.functions.length > 0 ? values.functions : values.codes.map((code) => `M${code}`));

function Outputs({ values }: { values: Values }) {
  const t = texts().machine;
  return (
    <p>
      {t.outputs}: {values.outputs.length + values.analog.length === 0 ? t.noOutputs : values.outputs.map((pin) => t.output(pin.axis, pin.output, pin.on)).concat(values.analog.map((one) => `${t.analogOutput} ${one.output} = ${one.value}`)).join(', ')}
      {values.codes.length > 0 && <>. {t.lastCodes}: {functionTexts(values).join(', ')}</>}
    </p>
  );
}

function Inputs({ values }: { values: Values }) {
  const t = texts().machine;
  if (values.inputs.length === 0) return null;
  return <p>{t.inputs}: {values.inputs.map((input) => t.input(input.name, input.on)).join(', ')}</p>;
}

export function LiveValues({ machine }: { machine: string }) {
  const t = texts().machine;
  const [beginning, setBeginning] = useState('');
  const values = useLoaded((signal) => get<Values>(pathOf('machines', machine, 'values'), { beginning }, signal), [machine, beginning]);
  useEffect(() => {
    const timer = setInterval(values.reload, kIntervalMs);
    return () => clearInterval(timer);
  }, []);
  const used = values.value ? usedValues(values.value.values) : [];
  return (
    <section aria-labelledby="values">
      <h2 id="values">{t.liveValues}</h2>
      <label>{t.beginning} <input value={beginning} autocomplete="off" maxLength={64} onInput={(e) => setBeginning(e.currentTarget.value.trim())} /></label>
      <Loading of={values} />
      {values.value && (
        <>
          <Outputs values={values.value} />
          <Inputs values={values.value} />
          {used.length === 0 && <p class="muted">{t.noValues}</p>}
          {used.length > 0 && (
            <table class="data">
              <thead><tr><th scope="col">{t.cell}</th><th scope="col">{t.value}</th></tr></thead>
              <tbody>{used.map((one) => <tr key={one.name}><th scope="row">{one.name}</th><td>{one.value}</td></tr>)}</tbody>
            </table>
          )}
          {values.value.next !== null && <p class="muted">{t.moreValues}</p>}
        </>
      )}
    </section>
  );
}
