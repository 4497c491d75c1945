/* Decodes the frames of the PC protocol from the bytes on the serial line. A zero byte ends each frame. The other bytes
   are coded with COBS: stuffing bytes replace the zeros. A CRC is at the end of the decoded bytes. */
(function (scope) {
  "use strict";

  const SIZES = { u8: 1, i8: 1, u16: 2, i16: 2, u32: 4, i32: 4, char8: 8 };
  const HEADER = 3;
  const CRC = 2;
  const BY_QUANTITY = "quantity"; // the unit of a set-point depends on its quantity

  function unstuffed(line) {
    const body = [];
    for (let at = 0; at < line.length;) {
      const end = at + line[at];
      if (line[at] === 0 || end > line.length) return null;
      body.push(...line.slice(at + 1, end));
      if (end < line.length) body.push(0);
      at = end;
    }
    return body;
  }

  function valueAt(view, field, at) {
    const read = {
      u8: () => view.getUint8(at),
      i8: () => view.getInt8(at),
      u16: () => view.getUint16(at, true),
      i16: () => view.getInt16(at, true),
      u32: () => view.getUint32(at, true),
      i32: () => view.getInt32(at, true),
      char8: () =>
        String.fromCharCode(...new Uint8Array(view.buffer, view.byteOffset + at, SIZES.char8)),
    };
    return read[field.t]();
  }

  /* Returns the values of the fields in a decoded frame (version, type, sequence number, payload). The keys are the names
     of the fields. */
  function valuesOf(body, frame) {
    const values = {};
    if (body.length < HEADER) return values;
    const view = new DataView(Uint8Array.from(body).buffer, HEADER);
    for (const field of frame.fields) {
      if (field.o + SIZES[field.t] > view.byteLength) break;
      const value = valueAt(view, field, field.o);
      values[field.n] = value;
      (field.b || []).forEach((bit, number) => {
        values[bit] = (value >> number) & 1;
      });
    }
    return values;
  }

  /* The frames of both directions of the serial line. A frame may be spread over several pieces of data. */
  class Line {
    constructor(frames) {
      this.kinds = new Map(frames.map((frame) => [frame.kind, frame]));
      this.rest = [[], []];
    }

    take(pieces) {
      const found = [];
      for (const piece of pieces) {
        const rest = this.rest[piece.fromPc ? 1 : 0];
        for (const byte of piece.bytes) {
          if (byte !== 0) {
            rest.push(byte);
            continue;
          }
          const bytes = rest.splice(0);
          if (!bytes.length) continue;
          const body = unstuffed(bytes);
          const kind = body && body.length >= HEADER + CRC ? this.kinds.get(body[1]) : undefined;
          found.push({
            at: piece.at,
            fromPc: piece.fromPc,
            name: kind ? kind.name : "damaged",
            bytes: [...bytes, 0],
            body: kind ? body.slice(0, -CRC) : null,
          });
        }
      }
      return found;
    }

    values(frame) {
      const kind = frame.body && this.kinds.get(frame.body[1]);
      return kind ? valuesOf(frame.body, kind) : {};
    }
  }

  /* Returns the value of a field as text: its name, or the number with its unit. */
  function shownValue(field, value) {
    if (field.v) return `${value} ${field.v[value] || ""}`.trim();
    if (field.b) return field.b.filter((_, bit) => (value >> bit) & 1).join(", ") || "no bit set";
    if (!field.u || field.u === BY_QUANTITY) return String(value);
    return field.s === 1 ? `${value} ${field.u}` : `${value}, that is ${value / Math.round(1 / field.s)} ${field.u}`;
  }

  /* Returns the parts of a frame in the order in which they are sent: the first stuffing byte, the header, the
     fields, the check sum and the zero byte at the end. The other stuffing bytes were sent in place of zeros. The
     parts contain these zeros. */
  function partsOf(line, frames) {
    const body = unstuffed(line.slice(0, -1)) || [];
    const kind = frames.find((frame) => frame.kind === body[1]);
    const payload = body.slice(HEADER, -CRC);
    const view = new DataView(Uint8Array.from(payload).buffer);
    const parts = [
      { bytes: [line[0]], name: "stuffing", meaning: "distance to the first byte that was zero before the coding" },
      { bytes: [body[0]], name: "version", value: body[0], meaning: "version of the protocol" },
      { bytes: [body[1]], name: "type", value: kind ? kind.name : body[1], meaning: "the type of the frame" },
      { bytes: [body[2]], name: "sequence", value: body[2], meaning: "number that the sender has assigned to the frame" },
    ];
    let at = 0;
    for (const field of kind ? kind.fields : []) {
      const size = SIZES[field.t];
      if (field.o + size > payload.length) break;
      const value = shownValue(field, valueAt(view, field, field.o));
      parts.push({ bytes: payload.slice(field.o, field.o + size), name: field.n, value, meaning: field.m });
      at = field.o + size;
    }
    if (at < payload.length)
      parts.push({ bytes: payload.slice(at), name: "more", meaning: "bytes after the last field that this version of the protocol defines" });
    parts.push({ bytes: body.slice(-CRC), name: "crc", meaning: "CRC-16/CCITT-FALSE of all bytes before it" });
    parts.push({ bytes: [0], name: "end", meaning: "the zero byte that ends the frame" });
    return parts;
  }

  scope.LiveFrames = { Line, valuesOf, unstuffed, partsOf };
  if (typeof module !== "undefined") module.exports = scope.LiveFrames;
})(typeof self !== "undefined" ? self : globalThis);
