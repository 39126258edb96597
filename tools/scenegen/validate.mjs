// node validate.mjs FILE...: Khronos' validator over glTF files; prints every error and warning, exits with 1 on any
// error. Needs the npm package gltf-validator (npm i gltf-validator@2.0.0-dev.3.10), found from the working folder.
import { createRequire } from 'node:module';
import { readFile } from 'node:fs/promises';
import { dirname, join, resolve } from 'node:path';

const { validateBytes } = createRequire(join(process.cwd(), 'package.json'))('gltf-validator');
const severityNames = ['error', 'warning', 'information', 'hint'];

const files = process.argv.slice(2);
if (files.length === 0) {
  console.error('usage: node validate.mjs FILE...');
  process.exit(2);
}
let errors = 0;
for (const file of files) {
  const report = await validateBytes(new Uint8Array(await readFile(file)), {
    uri: file,
    maxIssues: 0,
    externalResourceFunction: async (uri) => new Uint8Array(await readFile(resolve(dirname(file), decodeURIComponent(uri)))),
  });
  errors += report.issues.numErrors;
  for (const issue of report.issues.messages.filter((m) => m.severity <= 1)) {
    console.log(`${file}: ${issue.pointer ?? ''}: ${severityNames[issue.severity]} ${issue.code}: ${issue.message}`);
  }
}
console.log(`${files.length} files, ${errors} errors`);
process.exit(errors === 0 ? 0 : 1);
