// Asks the Khronos glTF validator what it says of a file that it did not say of another.
//
//   node validate_gltf.js PACKAGE ORIGINAL SAVED [ORIGINAL SAVED ...]
//
// Prints each new message and ends with 1 if there are any. Messages are told apart by their code and counted, since saving may move what they
// point to. Left out: that the validator cannot look into an extension, which says nothing of the file, and what is a matter of the artist's
// own data: sides of images that are no powers of two, texture coordinates that wait for a texture.
'use strict';
const path = require('path');
const issuesOf = require('./gltf_issues.js');
const [packageFolder, ...files] = process.argv.slice(2);

async function messagesOf(file) {
    return (await issuesOf(packageFolder, file)).filter(m => m.code !== 'UNSUPPORTED_EXTENSION' && m.code !== 'IMAGE_NPOT_DIMENSIONS' &&
        !(m.code === 'UNUSED_OBJECT' && /\/attributes\/TEXCOORD_\d$/.test(m.pointer)));
}

async function main() {
    let found = 0;
    for (let i = 0; i + 1 < files.length; i += 2) {
        const left = new Map();
        for (const m of await messagesOf(files[i])) left.set(m.code, (left.get(m.code) || 0) + 1);
        for (const m of await messagesOf(files[i + 1])) {
            const allowed = left.get(m.code) || 0;
            left.set(m.code, allowed - 1);
            if (allowed > 0) continue;
            console.log(`${path.basename(files[i + 1])}: ${m.code} ${m.pointer || ''}: ${m.message}`);
            ++found;
        }
    }
    process.exit(found ? 1 : 0);
}
main().catch(error => {
    console.log(String(error));
    process.exit(2);
});
