// SPDX-License-Identifier: MIT
// Runs the Khronos glTF validator over files: node validate.mjs LIST, where LIST is a text file with
// a path on each line. Prints for each file one line: the sorted codes of its messages, joined by
// commas, "-" if there are none.
// ELBOWROOM_GLTF_VALIDATOR names the node_modules folder that holds gltf-validator.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { basename, dirname, join } from 'node:path';

const modules = process.env.ELBOWROOM_GLTF_VALIDATOR;
if (!modules || process.argv.length !== 3) {
  console.error('usage: ELBOWROOM_GLTF_VALIDATOR=node_modules node validate.mjs LIST');
  process.exit(1);
}
const validator = createRequire(import.meta.url)(join(modules, 'gltf-validator'));

for (const file of readFileSync(process.argv[2], 'utf8').split('\n').filter((line) => line)) {
  const codes = new Set();
  try {
    const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
      uri: basename(file),
      maxIssues: 0,
      externalResourceFunction: async (uri) =>
        new Uint8Array(readFileSync(join(dirname(file), decodeURIComponent(uri)))),
    });
    for (const message of report.issues.messages) codes.add(message.code);
  } catch (error) {
    codes.add('UNREADABLE');
  }
  console.log(codes.size ? [...codes].sort().join(',') : '-');
}
