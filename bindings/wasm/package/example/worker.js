// Fairs what the page sends, beside it, and answers with both shapes and the file.

importScripts('../vspring_core.js');
const loading = vspringCore({ locateFile: (name) => `../${name}` });

onmessage = async ({ data: { bytes, name } }) => {
  const core = await loading;
  let surface;
  try {
    surface = new core.Surface(bytes, name);
    surface.setRules(JSON.stringify({ rules: [{ nodes: 'boundary', position: 'fixed', normal: 'fixed' }] }));
    const before = surface.positions();
    const report = surface.fair((fraction) => { postMessage({ fraction }); });
    postMessage({ faceBegin: surface.faceBegin(), corners: surface.corners(), before, after: surface.positions(), report, file: surface.write(name) });
  } catch (error) {
    postMessage({ error: error.message });
  } finally {
    surface?.delete();
  }
};
