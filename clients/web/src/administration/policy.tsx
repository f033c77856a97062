// The release policy in force: it is a file of the server, and is shown here as it was read.
import type { ReleasePolicy } from '../../generated/api';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { Rows } from '../parts/rows';
import { usePolicy } from '../parts/use_policy';
import { kSteps } from '../programs/release_steps';
import { texts } from '../texts/texts';

function Steps({ policy }: { policy: ReleasePolicy }) {
  const t = texts().policy;
  const release = texts().release;
  return (
    <div class="scroll" tabIndex={0} role="group" aria-labelledby="policy">
      <table class="data">
        <Heads of={[t.step, t.from, t.role, t.needs]} />
        <tbody>
          {kSteps.map((step) => {
            const rule = policy.steps[step];
            return (
              <tr key={step}>
                <th scope="row">{release.steps[step]}</th>
                <td>{rule.from.map((state) => release.states[state]).join(', ') || '–'}</td>
                <td>{texts().session.roles[rule.role]}</td>
                <td>{[rule.four_eyes && t.fourEyes, rule.comment && t.comment].filter(Boolean).join(', ') || '–'}</td>
              </tr>
            );
          })}
        </tbody>
      </table>
    </div>
  );
}

function rowsOf({ runs, prove_out, imports }: ReleasePolicy): Array<[string, string]> {
  const t = texts().policy;
  const { machines, role } = prove_out;
  return [
    [t.runs, t.runsOf[runs]],
    [t.proveOut, machines.length === 0 ? t.noMachine : t.proveOutBy(machines.join(', '), texts().session.roles[role])],
    [t.atOnce, imports.accept_at_once.map((word) => texts().imports.classes[word]).join(', ') || t.nothing],
  ];
}

export function Policy() {
  const t = texts().policy;
  const policy = usePolicy();
  const { value } = policy;
  return (
    <section class="panel" aria-labelledby="policy">
      <h2 id="policy">{t.title}</h2>
      <p class="hint">{t.hint}</p>
      <Loading of={policy} />
      {value && (
        <>
          <Rows of={rowsOf(value)} />
          <Steps policy={value} />
          <p class="hint mono">{t.digest} {value.sha256}</p>
          <p class="hint mono">{t.publicKey} {value.public_key}</p>
        </>
      )}
    </section>
  );
}
