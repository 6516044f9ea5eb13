// Prints the Khronos validator's findings on a glTF file. Exit status: 0 no errors or warnings, 1 some, 77 no validator.
// NODE_PATH names the folder of modules.
const fs = require("fs");

let validator;
try {
  validator = require("gltf-validator");
} catch {
  console.log("gltf-validator is not installed (tests/support/install_gltf_validator.sh)");
  process.exit(77);
}
const bytes = new Uint8Array(fs.readFileSync(process.argv[2]));
validator.validateBytes(bytes, {maxIssues: 50}).then((report) => {
  const {numErrors, numWarnings, numInfos, messages} = report.issues;
  console.log(`${numErrors} errors, ${numWarnings} warnings, ${numInfos} notes`);
  for (const m of messages) if (m.severity < 2) console.log(`${m.code} ${m.pointer ?? ""} ${m.message}`);
  process.exit(numErrors + numWarnings ? 1 : 0);
});
