// Calls a module that was built from src/lib.rs: `node run.mjs FILE.wasm`.
import { readFileSync } from 'node:fs';

const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]));
const [mean, expected] = [instance.exports.mean(), instance.exports.expected()];
console.log(`mean of 8 x 8 pixels: ${mean}, expected ${expected}`);
if (!(Math.abs(mean - expected) < 1e-6)) {
    process.exit(1);
}
