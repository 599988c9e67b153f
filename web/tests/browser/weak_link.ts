// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

import {createServer, connect, type AddressInfo, type Server, type Socket} from 'node:net';

/// A link to the server that can go silent, as a radio does behind a wall: what is sent waits, and nobody is told.
export class WeakLink {
  isSilent = false;
  losesSockets = false; // the page comes through, a request for a WebSocket does not
  #pairs: [Socket, Socket][] = [];
  #server: Server;

  private constructor(port: number) {
    this.#server = createServer((near) => {
      const far = connect(port, '127.0.0.1');
      this.#pairs.push([near, far]);
      let isSwallowed = false; // the page waits on, whatever the server makes of the silence
      for (const [from, to] of [[near, far], [far, near]] as const) {
        from.on('data', (data) => {
          const isLost = this.losesSockets && from === near && data.includes('Upgrade: websocket');
          isSwallowed ||= isLost;
          if (!isLost) to.write(data);
        });
        from.on('error', () => to.destroy());
        from.on('close', () => (isSwallowed && from === far) || to.destroy());
        if (this.isSilent) from.pause();
      }
    });
  }
  static async to(port: number): Promise<WeakLink> {
    const link = new WeakLink(port);
    await new Promise<void>((done) => link.#server.listen(0, '127.0.0.1', done));
    return link;
  }
  get url(): string {
    return `http://127.0.0.1:${(this.#server.address() as AddressInfo).port}/`;
  }
  goSilent(): void {
    this.isSilent = true;
    for (const sockets of this.#pairs) for (const socket of sockets) socket.pause();
  }
  speak(): void {
    this.isSilent = false;
    for (const sockets of this.#pairs) for (const socket of sockets) socket.resume();
  }
  close(): void {
    this.#server.close();
    for (const sockets of this.#pairs) for (const socket of sockets) socket.destroy();
  }
}
