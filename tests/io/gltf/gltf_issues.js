// What the Khronos glTF validator says of a file and of those beside it that it names.
'use strict';
const fs = require('fs');
const path = require('path');

// `packageFolder`: of the npm package. Resolves to the report's messages.
module.exports = async function issuesOf(packageFolder, file) {
    const folder = path.dirname(file);
    const report = await require(path.resolve(packageFolder)).validateBytes(new Uint8Array(fs.readFileSync(file)), {
        uri: path.basename(file),
        maxIssues: 0,
        externalResourceFunction: async uri => new Uint8Array(fs.readFileSync(path.join(folder, decodeURIComponent(uri)))),
    });
    return report.issues.messages;
};
