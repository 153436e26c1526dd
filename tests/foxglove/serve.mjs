// Files for the browser, on this machine alone. Studio reads an MCAP file in pieces, so ranges of bytes are answered.
import { createReadStream, existsSync, statSync } from "node:fs";
import http from "node:http";
import path from "node:path";

const types = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm" };

function answer(file, request, response) {
  const size = statSync(file).size;
  const range = /^bytes=(\d+)-(\d*)$/.exec(request.headers.range ?? "");
  const begin = range ? Number(range[1]) : 0;
  const last = range?.[2] ? Math.min(Number(range[2]), size - 1) : size - 1;
  response.writeHead(range ? 206 : 200, {
    "Content-Type": types[path.extname(file)] ?? "application/octet-stream",
    "Content-Length": last - begin + 1,
    "Accept-Ranges": "bytes",
    ...(range && { "Content-Range": `bytes ${begin}-${last}/${size}` }),
  });
  createReadStream(file, { start: begin, end: last }).pipe(response);
}

/** @param folders looked through in this order. Resolves to where it listens, once it does. */
export function serve(folders) {
  const server = http.createServer((request, response) => {
    const name = path.normalize(decodeURIComponent(new URL(request.url, "http://localhost").pathname));
    const file = folders.map((folder) => path.join(folder, name)).find((each) => existsSync(each) && statSync(each).isFile());
    if (file) answer(file, request, response);
    else response.writeHead(404).end();
  });
  return new Promise((resolve) =>
    server.listen(0, "127.0.0.1", () => resolve({ address: `http://127.0.0.1:${server.address().port}`, close: () => server.close() })),
  );
}
