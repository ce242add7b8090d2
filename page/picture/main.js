// Makes the picture that the program asks for, and leaves it as base64, alone in the document: see cli/picture.cpp.

import {jsonOf, sceneOf} from '../data.js';
import {panelsOf} from './panels.js';

const wanted = jsonOf('picture');

const answer = (kind, base64) => document.documentElement.replaceChildren(`${kind}:${base64};`);

function base64Of(text) {
  let bytes = '';
  for (const byte of new TextEncoder().encode(text)) bytes += String.fromCharCode(byte);
  return btoa(bytes);
}

// The document is loaded once the image is; only then does the browser print it.
function drawn(svg) {
  const image = new Image();
  image.src = `data:image/svg+xml;base64,${base64Of(svg)}`;
  document.body.append(image);
  window.addEventListener('load', () => {
    const scale = wanted.width / image.naturalWidth;
    const canvas = Object.assign(document.createElement('canvas'),
      {width: wanted.width, height: Math.round(image.naturalHeight * scale)});
    const context = canvas.getContext('2d');
    context.imageSmoothingQuality = 'high';
    context.drawImage(image, 0, 0, canvas.width, canvas.height);
    answer('picture', canvas.toDataURL('image/png').split(',')[1]);
  });
}

try {
  const svg = wanted.svg ?? panelsOf(sceneOf(jsonOf('scene')), wanted);
  if (wanted.format === 'svg') answer('picture', base64Of(svg));
  else drawn(svg);
} catch (error) {
  answer('error', base64Of(error.message));
}
