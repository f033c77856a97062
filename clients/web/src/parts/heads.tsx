// The first row of a table: what each of its columns is.
export function Heads({ of }: { of: string[] }) {
  return <thead><tr>{of.map((name) => <th scope="col" key={name}>{name}</th>)}</tr></thead>;
}
