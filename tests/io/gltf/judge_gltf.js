// Asks the Khronos glTF validator for its verdicts.
//
//   node judge_gltf.js PACKAGE FILE [FILE ...]
//
// Prints one line of JSON for each file: a list of [severity, code, pointer], severity 0 being an error, 1 a warning, 2 information. What it
// cannot even begin to read is an error as well.
'use strict';
const issuesOf = require('./gltf_issues.js');
const [packageFolder, ...files] = process.argv.slice(2);

async function verdict(file) {
    return (await issuesOf(packageFolder, file)).map(m => [m.severity, m.code, m.pointer || '']);
}

async function main() {
    for (const file of files) console.log(JSON.stringify(await verdict(file).catch(error => [[0, 'UNREADABLE', String(error).split('\n')[0]]])));
}
main();
