// The release policy in force: it is a file of the server, and is shown here as it was read.
import type { ReleasePolicy } from '../../generated/api';
import { Loading } from '../parts/loading';
import { usePolicy } from '../parts/use_policy';
import { kSteps } from '../programs/release_steps';
import { texts } from '../texts/texts';

function Steps({ policy }: { policy: ReleasePolicy }) {
  const t = texts().policy;
  const release = texts().release;
  return (
    <div class="scroll" tabIndex={0} role="group" aria-labelledby="policy">
      <table class="data">
        <thead><tr>{[t.step, t.from, t.role, t.needs].map((name) => <th scope="col" key={name}>{name}</th>)}</tr></thead>
        <tbody>
          {kSteps.map((step) => {
            const rule = policy.steps[step];
            return (
              <tr key={step}>
                <th scope="row">{release.steps[step]}</th>
                <td>{rule.from.map((state) => release.states[state]).join(', ') || '–'}</td>
                <td>{texts().session.roles[rule.role]}</td>
                <td>{[rule.four_eyes ? t.fourEyes : null, rule.comment ? t.comment : null].filter(Boolean).join(', ') || '–'}</td>
              </tr>
            );
          })}
        </tbody>
      </table>
    </div>
  );
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
          <dl class="rows">
            <div><dt>{t.runs}</dt><dd>{t.runsOf[value.runs]}</dd></div>
            <div><dt>{t.proveOut}</dt><dd>{value.prove_out.machines.length === 0 ? t.noMachine : t.proveOutBy(value.prove_out.machines.join(', '), texts().session.roles[value.prove_out.role])}</dd></div>
            <div><dt>{t.atOnce}</dt><dd>{value.imports.accept_at_once.map((word) => texts().imports.classes[word]).join(', ') || t.nothing}</dd></div>
          </dl>
          <Steps policy={value} />
          <p class="hint mono">{t.digest} {value.sha256}</p>
          <p class="hint mono">{t.publicKey} {value.public_key}</p>
        </>
      )}
    </section>
  );
}
