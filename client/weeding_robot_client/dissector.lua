-- The lines above contain the frames. They are generated from design/frames.toml. A packet is one
-- frame as on the serial line, with byte stuffing, a body with its CRC, and a zero at the end. The
-- link type is USER0.

local proto = Proto("weeding_robot", "Weeding robot PC protocol")
local HEADER, CRC_BYTES = 3, 2

local function text_field(name, label) return ProtoField.string("weeding_robot." .. name, label) end

local line = {
  version = ProtoField.uint8("weeding_robot.version", "version"),
  type = ProtoField.uint8("weeding_robot.type", "type", base.HEX),
  sequence = ProtoField.uint8("weeding_robot.sequence", "sequence"),
  crc = ProtoField.uint16("weeding_robot.crc", "CRC", base.HEX),
  error = text_field("error", "error"),
}
local all = { line.version, line.type, line.sequence, line.crc, line.error }

local function proto_field(field)
  if field.scale then return ProtoField.double(field.filter, field.label) end
  if field.type == "char8" then return ProtoField.string(field.filter, field.label) end
  local make = { u8 = "uint8", u16 = "uint16", u32 = "uint32", i8 = "int8", i16 = "int16", i32 = "int32" }
  return ProtoField[make[field.type]](field.filter, field.label, base.DEC, field.values)
end

local by_type = {}
for _, frame in ipairs(frames) do
  by_type[frame.type] = frame
  for _, field in ipairs(frame.fields) do
    field.proto = proto_field(field)
    table.insert(all, field.proto)
    for _, bit in ipairs(field.bits) do
      bit.proto = ProtoField.bool(bit.filter, bit.label, 8 * field.size, nil, 2 ^ bit.number)
      table.insert(all, bit.proto)
    end
  end
end
proto.fields = all

local function xor(a, b)
  local result, place = 0, 1
  while a > 0 or b > 0 do
    if a % 2 ~= b % 2 then result = result + place end
    a, b, place = math.floor(a / 2), math.floor(b / 2), place * 2
  end
  return result
end

local crc_of = {}
for value = 0, 255 do
  local crc = value * 256
  for _ = 1, 8 do
    local high = crc >= 0x8000
    crc = (crc * 2) % 0x10000
    if high then crc = xor(crc, 0x1021) end
  end
  crc_of[value] = crc
end

-- Returns the CRC-16/CCITT-FALSE of the first bytes of a body.
local function crc16(body, count)
  local crc = 0xFFFF
  for i = 0, count - 1 do
    crc = xor((crc * 256) % 0x10000, crc_of[xor(math.floor(crc / 256), body:get_index(i))])
  end
  return crc
end

-- Returns the body of a frame on the serial line; nil when the byte stuffing is wrong.
local function unstuffed(bytes)
  local body, at, last = {}, 0, bytes:len()
  if last > 0 and bytes:get_index(last - 1) == 0 then last = last - 1 end
  while at < last do
    local code = bytes:get_index(at)
    if code == 0 or at + code > last then return nil end
    for i = at + 1, at + code - 1 do table.insert(body, string.format("%02x", bytes:get_index(i))) end
    at = at + code
    if at < last and code < 255 then table.insert(body, "00") end
  end
  return ByteArray.new(table.concat(body))
end

local function number(range, type)
  local signed = type:sub(1, 1) == "i"
  return signed and range:le_int() or range:le_uint()
end

local function range_of(payload, field) return payload(field.offset, field.size) end

local function is_valid(payload, field)
  local mask = field.valid
  if not mask then return true end
  return math.floor(payload(mask.offset, mask.size):le_uint() / 2 ^ mask.bit) % 2 == 1
end

local function scale_of(payload, field)
  if not field.scales then return field.scale end
  return field.scales[payload(field.scale_offset, 1):uint()] or 1
end

local function add(tree, payload, field)
  local range = range_of(payload, field)
  if not is_valid(payload, field) then return end
  if field.scale then
    tree:add(field.proto, range, number(range, field.type) / scale_of(payload, field))
  elseif field.type == "char8" then
    tree:add(field.proto, range)
  else
    local item = tree:add_le(field.proto, range)
    for _, bit in ipairs(field.bits) do item:add_le(bit.proto, range) end
  end
end

local function fail(tree, info, text)
  tree:add(line.error, text)
  tree:add_expert_info(PI_MALFORMED, PI_ERROR, text)
  info.cols.info = text
end

function proto.dissector(buffer, info, root)
  info.cols.protocol = "WR"
  local tree = root:add(proto, buffer())
  local body = unstuffed(buffer:bytes())
  if not body then return fail(tree, info, "damaged byte stuffing") end
  if body:len() < HEADER + CRC_BYTES then return fail(tree, info, "body too short") end
  local frame_bytes = body:tvb("Frame")
  local count = body:len() - CRC_BYTES
  tree:add(line.version, frame_bytes(0, 1))
  tree:add(line.type, frame_bytes(1, 1))
  tree:add(line.sequence, frame_bytes(2, 1))
  tree:add_le(line.crc, frame_bytes(count, CRC_BYTES))
  if crc16(body, count) ~= frame_bytes(count, CRC_BYTES):le_uint() then
    return fail(tree, info, "wrong CRC")
  end
  local frame = by_type[frame_bytes(1, 1):uint()]
  if not frame then return fail(tree, info, "unknown type") end
  info.cols.info = frame.name
  local size = count - HEADER
  if size < frame.size then
    info.cols.info = frame.name .. ", " .. size .. " bytes"
    return
  end
  if frame.size == 0 then return end
  local payload = frame_bytes(HEADER, size):tvb()
  for _, field in ipairs(frame.fields) do add(tree, payload, field) end
end

DissectorTable.get("wtap_encap"):add(wtap.USER0, proto)
