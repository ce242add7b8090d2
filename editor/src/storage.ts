// A few values that outlive the page, in the browser's IndexedDB. All promises fail where it keeps nothing.

function kept<Value>(request: IDBRequest<Value>): Promise<Value> {
  return new Promise((done, failed) => {
    request.onsuccess = () => done(request.result);
    request.onerror = () => failed(request.error);
  });
}

let database: Promise<IDBDatabase> | null = null;

function opened(): Promise<IDBDatabase> {
  database ??= new Promise((done, failed) => {
    const request = indexedDB.open('vspring-editor', 1);
    request.onupgradeneeded = () => request.result.createObjectStore('kept');
    kept(request).then(done, failed);
  });
  return database;
}

/** All or none of them are stored; undefined takes a value away. */
export async function store(values: Record<string, unknown>): Promise<void> {
  const transaction = (await opened()).transaction('kept', 'readwrite');
  const ended = new Promise<void>((done, failed) => {
    transaction.oncomplete = () => done();
    transaction.onabort = () => failed(transaction.error);
  });
  for (const [key, value] of Object.entries(values)) {
    if (value === undefined) transaction.objectStore('kept').delete(key);
    else transaction.objectStore('kept').put(value, key);
  }
  await ended;
}

export async function stored(...keys: string[]): Promise<unknown[]> {
  const objects = (await opened()).transaction('kept').objectStore('kept');
  return Promise.all(keys.map((key) => kept(objects.get(key))));
}
