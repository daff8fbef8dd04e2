// Asks the Khronos glTF validator for its verdicts.
//
//   node judge_gltf.js PACKAGE FILE [FILE ...]
//
// Prints one line of JSON for each file: a list of [severity, code, pointer], severity 0 being an error, 1 a warning, 2 information. What it
// cannot even begin to read is an error as well.
'use strict';
const fs = require('fs');
const path = require('path');
const [packageFolder, ...files] = process.argv.slice(2);
const validator = require(path.resolve(packageFolder));

async function verdict(file) {
    const folder = path.dirname(file);
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
        uri: path.basename(file),
        maxIssues: 0,
        externalResourceFunction: async uri => new Uint8Array(fs.readFileSync(path.join(folder, decodeURIComponent(uri)))),
    });
    return report.issues.messages.map(m => [m.severity, m.code, m.pointer || '']);
}

async function main() {
    for (const file of files) console.log(JSON.stringify(await verdict(file).catch(error => [[0, 'UNREADABLE', String(error).split('\n')[0]]])));
}
main();
