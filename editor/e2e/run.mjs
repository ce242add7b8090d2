// Runs all end-to-end tests in one browser: node e2e/run.mjs [FILE…]

import { spawnSync } from 'node:child_process';
import { readdirSync } from 'node:fs';
import { chromium } from 'playwright-core';
import { launching } from './support.mjs';

const folder = new URL('./', import.meta.url).pathname;
const given = process.argv.slice(2);
const files = given.length > 0 ? given : readdirSync(folder).filter((name) => name.endsWith('.test.mjs')).map((name) => folder + name);
const server = await chromium.launchServer(launching);
const { status } = spawnSync(process.execPath, ['--test', '--test-concurrency=1', ...files],
  { stdio: 'inherit', env: { ...process.env, VSPRING_BROWSER: server.wsEndpoint() } });
await server.close();
process.exitCode = status ?? 1;
