/* Frames of the PC protocol on the line: between zeros, stuffed, with a CRC. */
(function (scope) {
  "use strict";

  const SIZES = { u8: 1, i8: 1, u16: 2, i16: 2, u32: 4, i32: 4, char8: 8 };
  const HEADER = 3;
  const CRC = 2;

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

  /* The values of a body (version, type, sequence number, payload), by the names of the fields. */
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

  /* Collects the frames of both directions. */
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

  scope.LiveFrames = { Line, valuesOf, unstuffed };
  if (typeof module !== "undefined") module.exports = scope.LiveFrames;
})(typeof self !== "undefined" ? self : globalThis);
