// The groups of machines: who is in a group may act on its machines.
import { useState } from 'preact/hooks';
import type { MachineGroup, MachineGroups } from '../../generated/api';
import { get, pathOf, send } from '../api/request';
import { useFeed } from '../live/use_feed';
import { Allowed } from '../parts/allowed';
import { CommandFault, useCommand, type Command } from '../parts/command';
import { Loading } from '../parts/loading';
import { SureButton } from '../parts/sure_button';
import { useLoaded } from '../parts/use_loaded';
import { texts } from '../texts/texts';

/// Has every machine, always.
const kAll = 'all';

interface CardProps {
  group: MachineGroup;
  command: Command;
  change: (method: 'PUT' | 'DELETE', ...path: string[]) => void;
}

function GroupCard({ group, command, change }: CardProps) {
  const t = texts().groups;
  const feed = useFeed('machines');
  const [machine, setMachine] = useState('');
  const others = [...feed.machines.keys()].filter((name) => !group.machines.includes(name)).sort();
  const list = `machines-${group.name}`;
  const add = (event: Event) => {
    event.preventDefault();
    change('PUT', group.name, 'machines', machine.trim());
    setMachine('');
  };
  return (
    <li class="panel">
      <h3>{group.name}</h3>
      {group.name === kAll ? <p class="muted">{t.every}</p> : (
        <>
          <ul class="members">
            {group.machines.map((name) => (
              <li key={name}>
                {name} <button type="button" class="quiet" aria-label={t.removeMachine(name, group.name)} disabled={command.isBusy} onClick={() => change('DELETE', group.name, 'machines', name)}>×</button>
              </li>
            ))}
          </ul>
          {group.machines.length === 0 && <p class="muted">{t.empty}</p>}
          <form class="with-button" onSubmit={add}>
            <label>{t.addMachine}<input required list={list} autocomplete="off" value={machine} onInput={(e) => setMachine(e.currentTarget.value)} /></label>
            <datalist id={list}>{others.map((name) => <option key={name} value={name} />)}</datalist>
            <button type="submit" disabled={command.isBusy}>{t.addTo(group.name)}</button>
            <SureButton class="danger" label={t.remove} question={t.removeSure(group.name)} disabled={command.isBusy} onSure={() => change('DELETE', group.name)} />
          </form>
        </>
      )}
    </li>
  );
}

export function Groups() {
  const t = texts().groups;
  const command = useCommand();
  const [name, setName] = useState('');
  const groups = useLoaded((signal) => get<MachineGroups>(pathOf('machine-groups'), {}, signal), []);
  const change = async (method: 'PUT' | 'DELETE', ...path: string[]) => {
    const isDone = await command.send(() => send(method, pathOf('machine-groups', ...path)));
    if (isDone) groups.reload();
    return isDone;
  };
  const add = async (event: Event) => {
    event.preventDefault();
    if (await change('PUT', name.trim())) setName('');
  };
  return (
    <section aria-labelledby="groups">
      <h2 id="groups">{t.title}</h2>
      <p class="hint">{t.hint}</p>
      <Loading of={groups} />
      <Allowed to="administer">
        <CommandFault command={command} />
        <ul class="list">
          {(groups.value?.groups ?? []).map((group) => <GroupCard key={group.name} group={group} command={command} change={(...what) => void change(...what)} />)}
        </ul>
        <form class="panel with-button" onSubmit={(event) => void add(event)}>
          <label>{t.name}<input required maxLength={64} autocomplete="off" autocapitalize="none" value={name} onInput={(e) => setName(e.currentTarget.value)} /></label>
          <button type="submit" class="primary" disabled={command.isBusy}>{t.add}</button>
        </form>
      </Allowed>
    </section>
  );
}
