// The characters of a serial line, readable: printable ones as they are, controls by their names. Pure.
const kNames = ['NUL', 'SOH', 'STX', 'ETX', 'EOT', 'ENQ', 'ACK', 'BEL', 'BS', 'HT', 'LF', 'VT', 'FF', 'CR', 'SO', 'SI', 'DLE', 'DC1', 'DC2', 'DC3', 'DC4',
  'NAK', 'SYN', 'ETB', 'CAN', 'EM', 'SUB', 'ESC', 'FS', 'GS', 'RS', 'US'];

/// `hex`: two digits a character, as the API gives them.
export function readableBytes(hex: string): string {
  let text = '';
  for (let i = 0; i + 1 < hex.length; i += 2) {
    const code = parseInt(hex.slice(i, i + 2), 16);
    if (code < 0x20) text += `⟨${kNames[code]}⟩`;
    else if (code < 0x7f) text += String.fromCharCode(code);
    else text += code === 0x7f ? '⟨DEL⟩' : `⟨${hex.slice(i, i + 2)}⟩`;
  }
  return text;
}
