// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Speaks MAVLink over UDP with node-mavlink, which is not ours. Prints its port; then, for each datagram:
//   a frame     -> "MESSAGE field=1,2 ...": what node-mavlink reads in it, or "bad: WHY"
//   "N MESSAGE" -> N datagrams, each a frame of random fields and, behind it, the same text of what was put in
// Integers are told as they are, floats as their bits. Ends with its standard input.

const dgram = require('node:dgram');
const { MavLinkPacketParser, MavLinkPacketSplitter, MavLinkProtocolV2 } = require('node-mavlink');
const { minimal, standard, common, ardupilotmega } = require('mavlink-mappings');

const registry = { ...minimal.REGISTRY, ...standard.REGISTRY, ...common.REGISTRY, ...ardupilotmega.REGISTRY };
const kindByName = Object.fromEntries(Object.values(registry).map((kind) => [kind.MSG_NAME, kind]));

const bits = new DataView(new ArrayBuffer(8));
function floatBits(value) {
  bits.setFloat32(0, value);
  return bits.getUint32(0);
}

function element(type, value) {
  if (type === 'float') return String(floatBits(value));
  return String(value);
}

function valueText(field, value) {
  const type = field.type.replace('[]', '').replace('_mavlink_version', '');
  if (!field.type.endsWith('[]')) return element(type, value);
  const all = type === 'char' ? [...value].map((c) => c.charCodeAt(0)) : [...value];
  while (all.length < field.length) all.push(0);
  return all.map((one) => element(type, one)).join(',');
}

function text(message) {
  const kind = message.constructor;
  return [kind.MSG_NAME, ...kind.FIELDS.map((f) => `${f.source}=${valueText(f, message[f.name])}`)].join(' ');
}

function randomElement(type) {
  for (let i = 0; i < 8; ++i) bits.setUint8(i, Math.floor(Math.random() * 256));
  switch (type) {
    case 'char': return String.fromCharCode(97 + Math.floor(Math.random() * 26));
    case 'float': { const value = bits.getFloat32(0); return Number.isNaN(value) ? 0.5 : value; }
    case 'int8_t': return bits.getInt8(0);
    case 'uint8_t': return bits.getUint8(0);
    case 'int16_t': return bits.getInt16(0);
    case 'uint16_t': return bits.getUint16(0);
    case 'int32_t': return bits.getInt32(0);
    case 'uint32_t': return bits.getUint32(0);
    case 'int64_t': return bits.getBigInt64(0);
    case 'uint64_t': return bits.getBigUint64(0);
    default: throw new Error(`no random ${type}`);
  }
}

/// Fields from some place on may be zero, so that frames are cut short.
function randomMessage(kind) {
  const message = new kind();
  let left = Math.random() < 0.5 ? kind.FIELDS.length : Math.floor(Math.random() * kind.FIELDS.length);
  for (const field of kind.FIELDS) {
    const type = field.type.replace('[]', '').replace('_mavlink_version', '');
    const one = () => (left > 0 ? randomElement(type) : type.includes('64') ? 0n : type === 'char' ? '' : 0);
    const isArray = field.type.endsWith('[]');
    const all = Array.from({ length: isArray ? field.length : 1 }, one);
    message[field.name] = !isArray ? all[0] : type === 'char' ? all.join('') : all;
    --left;
  }
  return message;
}

const socket = dgram.createSocket('udp4');
const protocol = new MavLinkProtocolV2(7, 1);
let sequence = 0;

function send(buffer, to) {
  socket.send(buffer, to.port, to.address);
}

// The library's own way from bytes to packets: splitter, then parser.
const splitter = new MavLinkPacketSplitter({}, { onCrcError: () => { wrong = 'checksum'; } });
const parser = new MavLinkPacketParser();
let wrong = 'no frame';
let read = null;
splitter.pipe(parser);
parser.on('data', (packet) => {
  const kind = registry[packet.header.msgid];
  read = text(packet.protocol.data(packet.payload, kind));
  answer();
});
let asker = null;
function answer() {
  send(Buffer.from(read ?? `bad: ${wrong}`), asker);
  read = null;
}

socket.on('message', (datagram, from) => {
  asker = from;
  if (datagram[0] === 0xfd) {
    splitter.write(datagram);
    return;
  }
  const [count, name] = datagram.toString().split(' ');
  for (let i = 0; i < Number(count); ++i) {
    const message = randomMessage(kindByName[name]);
    send(Buffer.concat([protocol.serialize(message, sequence++ & 255), Buffer.from(text(message))]), from);
  }
});
socket.bind(0, '127.0.0.1', () => console.log(socket.address().port));
process.stdin.on('end', () => process.exit(0));
process.stdin.resume();
