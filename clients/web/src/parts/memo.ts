// A component that is drawn again only when a property has changed; preact has this in `preact/compat`, which is larger than the rest.
import { Component, h, type ComponentChildren, type FunctionComponent } from 'preact';

export function memo<P extends object>(inner: (props: P) => ComponentChildren): FunctionComponent<P> {
  class Memo extends Component<P> {
    override shouldComponentUpdate(next: Readonly<P>): boolean {
      const keys = new Set([...Object.keys(next), ...Object.keys(this.props)]) as Set<keyof P>;
      return [...keys].some((key) => (next as P)[key] !== (this.props as P)[key]);
    }
    override render() {
      return h(inner as FunctionComponent<P>, this.props as P);
    }
  }
  return Memo as unknown as FunctionComponent<P>;
}
