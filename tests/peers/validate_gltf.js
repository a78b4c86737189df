// node validate_gltf.js FILE...: the Khronos glTF validator's verdict on each file, a line each:
// FILE errors warnings infos hints triangles; then its messages. Exit status 1 when any has an error or a warning.
// RAMIFY_PEERS names the folder with node_modules/.
const fs = require('fs');
const validator = require(process.env.RAMIFY_PEERS + '/node_modules/gltf-validator');

async function main() {
    let bad = 0;
    for (const file of process.argv.slice(2)) {
        const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {maxIssues: 0});
        const {numErrors, numWarnings, numInfos, numHints} = report.issues;
        const triangles = report.info ? report.info.totalTriangleCount : 0;
        console.log(file, numErrors, numWarnings, numInfos, numHints, triangles);
        for (const issue of report.issues.messages) {
            console.log('   ', ['error', 'warning', 'info', 'hint'][issue.severity], issue.code, issue.pointer || '', issue.message);
        }
        bad += numErrors + numWarnings;
    }
    process.exit(bad ? 1 : 0);
}
main();
