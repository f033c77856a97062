// The shop floor: every machine as a card, a filter, and a wall mode for a large screen. The filter is part of the address.
import { addressOf } from '../app/route';
import { useFeed } from '../live/use_feed';
import { texts } from '../texts/texts';
import { filterQuery, kTones, listFloor, readFilter, type FloorFilter, type FloorList } from './filter';
import { MachineCard } from './machine_card';

function show(filter: FloorFilter): void {
  history.replaceState(null, '', addressOf('floor', [], filterQuery(filter)));
  dispatchEvent(new HashChangeEvent('hashchange'));
}

function FilterBar({ filter, list }: { filter: FloorFilter; list: FloorList }) {
  const t = texts().floor;
  return (
    <div class="tools" role="search">
      <label class="search">
        <span class="visually-hidden">{t.filter}</span>
        <input type="search" placeholder={t.filterHint} value={filter.text} onInput={(e) => show({ ...filter, text: e.currentTarget.value })} />
      </label>
      <div class="chips" role="group" aria-label={t.states}>
        <button type="button" aria-pressed={filter.tone === null} onClick={() => show({ ...filter, tone: null })}>{t.all}</button>
        {kTones.map((tone) => (
          <button key={tone} type="button" class={tone} aria-pressed={filter.tone === tone}
            onClick={() => show({ ...filter, tone: filter.tone === tone ? null : tone })}>
            {t.tones[tone]} <b>{list.counts[tone]}</b>
          </button>
        ))}
      </div>
      <a class="button" href={addressOf('floor', [], { ...filterQuery(filter), wall: '1' })}>{t.wall}</a>
    </div>
  );
}

function WallBar({ filter, list }: { filter: FloorFilter; list: FloorList }) {
  const t = texts().floor;
  return (
    <div class="tools wall-bar">
      <span class="count">{t.count(list.names.length, list.all)}</span>
      {kTones.map((tone) => <span key={tone} class={`pill ${tone}`}>{t.tones[tone]} {list.counts[tone]}</span>)}
      <button type="button" class="quiet" onClick={() => void document.documentElement.requestFullscreen?.()}>{t.fullScreen}</button>
      <a class="button quiet" href={addressOf('floor', [], filterQuery(filter))}>{t.leaveWall}</a>
    </div>
  );
}

export function Floor({ query }: { query: URLSearchParams }) {
  const feed = useFeed('machines', 'link');
  const t = texts().floor;
  const filter = readFilter(query);
  const list = listFloor(feed.machines, (machine) => feed.runOf(machine), filter);
  const Bar = query.has('wall') ? WallBar : FilterBar;
  return (
    <>
      <h1 class="visually-hidden">{t.title}</h1>
      <Bar filter={filter} list={list} />
      {list.names.length === 0 && feed.link.state !== 'connecting' && <p class="notice">{list.all === 0 ? t.none : t.noneFits}</p>}
      <ul class="cards">{list.names.map((name) => <MachineCard key={name} name={name} />)}</ul>
    </>
  );
}
