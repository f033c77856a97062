// Facts as rows: a name, and its value.
export function Rows({ of }: { of: Array<[string, string]> }) {
  return <dl class="rows">{of.map(([name, value]) => <div key={name}><dt>{name}</dt><dd>{value}</dd></div>)}</dl>;
}
