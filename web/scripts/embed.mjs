// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors
//
// node scripts/embed.mjs BUILT_PAGE OUT.cpp
// Compresses the files of the built page and writes them as the C++ source that the program is linked with.

import {mkdirSync, readFileSync, readdirSync, writeFileSync} from 'node:fs';
import {dirname, extname, join, relative} from 'node:path';
import {gzipSync} from 'node:zlib';

const mimeOf = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.svg': 'image/svg+xml',
  '.woff2': 'font/woff2',
};

function filesOf(folder) {
  return readdirSync(folder, {withFileTypes: true})
    .flatMap((entry) => (entry.isDirectory() ? filesOf(join(folder, entry.name)) : join(folder, entry.name)))
    .sort();
}

const [built, out] = process.argv.slice(2);
const arrays = [];
const rows = [];
for (const [i, file] of filesOf(built).entries()) {
  const mime = mimeOf[extname(file)];
  if (!mime) throw new Error(`${file}: no MIME type is known for '${extname(file)}'; add it to scripts/embed.mjs`);
  const gzip = gzipSync(readFileSync(file), {level: 9});
  const numbers = Array.from(gzip, (byte, k) => byte + (k % 32 === 31 ? ',\n' : ',')).join('');
  arrays.push(`constexpr std::uint8_t kFile${i}[] = {\n${numbers}};\n`);
  rows.push(`    {"/${relative(built, file).replaceAll('\\', '/')}", "${mime}", kFile${i}},\n`);
}
mkdirSync(dirname(out), {recursive: true});
writeFileSync(
  out,
  `// Generated from web/ by web/scripts/embed.mjs; do not edit.

#include "swiftlet/station/http/http_answer.hpp"

namespace swiftlet::station {
namespace {

${arrays.join('\n')}
constexpr PageFile kPageFiles[] = {
${rows.join('')}};

}  // namespace

std::span<const PageFile> page_files() { return kPageFiles; }

}  // namespace swiftlet::station
`,
);
