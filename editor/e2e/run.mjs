// Runs all end-to-end tests, or those of the files that are named, in one browser. What failed is printed again at the end, and the status is 1.

import { spawn } from 'node:child_process';
import { readdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';
import { launch } from './support.mjs';

const folder = fileURLToPath(new URL('.', import.meta.url));
const named = process.argv.slice(2);
const files = named.length > 0 ? named : readdirSync(folder).filter((name) => name.endsWith('.test.mjs')).map((name) => folder + name);
const server = await chromium.launchServer(launch);
const tests = spawn(process.execPath, ['--test', '--test-concurrency=1', '--test-reporter=spec', ...files], { stdio: 'inherit', env: { ...process.env, VSPRING_BROWSER: server.wsEndpoint() } });
tests.on('exit', async (status) => {
  await server.close();
  process.exitCode = status ?? 1;
});
