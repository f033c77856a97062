// Makes the TypeScript types of the API from its description: node tools/api_types.mjs openapi.json api.ts
// It knows the part of OpenAPI that the description uses, and stops at a word that it does not know.
import { mkdir, readFile, rename, writeFile } from 'node:fs/promises';
import path from 'node:path';

const [from, to] = process.argv.slice(2);
const document = JSON.parse(await readFile(from, 'utf8'));

/// What only narrows values or explains them has no place in a type.
const kIgnored = new Set(['description', 'format', 'pattern', 'minimum', 'maximum', 'minLength', 'maxLength', 'minProperties', 'maxItems', 'default', 'example']);
const kKnown = new Set(['$ref', 'type', 'properties', 'required', 'additionalProperties', 'items', 'enum', 'nullable', 'allOf']);

function typeOf(schema, where) {
  for (const word of Object.keys(schema)) {
    if (!kKnown.has(word) && !kIgnored.has(word)) throw new Error(`${where}: '${word}' is not known to api_types.mjs`);
  }
  const type = bareTypeOf(schema, where);
  return schema.nullable ? `${type} | null` : type;
}

function bareTypeOf(schema, where) {
  if (schema.$ref) return schema.$ref.split('/').at(-1);
  if (schema.allOf?.length === 1) return typeOf(schema.allOf[0], where);  // how OpenAPI 3.0 writes a reference that may be null
  if (schema.enum) return schema.enum.map((word) => JSON.stringify(word)).join(' | ');
  switch (schema.type) {
    case 'string': return 'string';
    case 'integer':
    case 'number': return 'number';
    case 'boolean': return 'boolean';
    case 'array': return `Array<${typeOf(schema.items, `${where}[]`)}>`;
    case 'object': return objectType(schema, where);
    default: throw new Error(`${where}: type '${schema.type}' is not known to api_types.mjs`);
  }
}

function objectType(schema, where) {
  if (!schema.properties) {
    const values = schema.additionalProperties;
    return `{ [name: string]: ${values && values !== true ? typeOf(values, where) : 'unknown'} }`;
  }
  const required = new Set(schema.required ?? []);
  const rows = Object.entries(schema.properties).map(([name, member]) => {
    const note = member.description ? `  /** ${member.description.replaceAll('*/', '* /')} */\n` : '';
    return `${note}  ${JSON.stringify(name)}${required.has(name) ? '' : '?'}: ${typeOf(member, `${where}.${name}`)};`;
  });
  return `{\n${rows.join('\n')}\n}`;
}

const types = Object.entries(document.components.schemas).map(([name, schema]) => `export type ${name} = ${typeOf(schema, name)};`);
await mkdir(path.dirname(to), { recursive: true });
// Renamed into place: another build may read it at this moment.
await writeFile(`${to}.${process.pid}`, `// Made from openapi.json by tools/api_types.mjs.\n\n${types.join('\n\n')}\n`);
await rename(`${to}.${process.pid}`, to);
