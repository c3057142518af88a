
local proto = Proto("innfos", TITLE)
local crc_of = crc_function(CRC)
local PREFIX = 5 -- header, address, command, length

-- Fields ----------------------------------------------------------------------------------------

local command_names, mode_names, alarm_bits = {}, {}, {}
for code, row in pairs(COMMANDS) do
  command_names[code] = (row.operation == "read" and "Read " or "Write ") .. row.name
end
for code, name in pairs(MODES) do mode_names[code] = name end

local f = common_fields("innfos")
f.header = ProtoField.uint8("innfos.header", "Header", base.HEX)
f.kind = ProtoField.string("innfos.direction", "Direction")
f.address = ProtoField.uint8("innfos.address", "Address")
f.command = ProtoField.uint8("innfos.command", "Command", base.HEX, command_names)
f.length = ProtoField.uint16("innfos.length", "Length")
f.data = ProtoField.bytes("innfos.data", "Data", base.SPACE)
f.number = ProtoField.double("innfos.value", "Value")
f.flag = ProtoField.uint8("innfos.flag", "Flag", base.DEC, FLAGS)
f.mode = ProtoField.uint8("innfos.mode", "Mode", base.DEC, mode_names)
f.alarms = ProtoField.uint16("innfos.alarms", "Alarms", base.HEX)
f.tail = ProtoField.uint8("innfos.end", "End", base.HEX)

local unnamed = 0xFFFF
for index, row in ipairs(ALARMS) do
  unnamed = bit.band(unnamed, bit.bnot(row.mask))
  alarm_bits[index] = ProtoField.bool("innfos.alarms." .. filter_name(row.name), row.name, 16, nil, row.mask)
  f["alarm" .. index] = alarm_bits[index]
end
f.other_alarm = ProtoField.uint16("innfos.alarms." .. filter_name(OTHER_ALARM), OTHER_ALARM, base.HEX, nil, unnamed)
proto.fields = f

local experts = add_experts(proto, {
  header = { "No packet begins here", "WARN" },
  truncated = { "The packet is shorter than its length says", "ERROR" },
  tail = { "The end byte is not where the length says", "ERROR" },
  crc = { "The CRC is wrong", "ERROR" },
  needless_crc = { "A CRC where the documents have none", "WARN" },
  command = { "Unknown command", "WARN" },
  data = { "The command has no data of this size in this direction", "WARN" },
  value = { "The documents do not explain this value", "WARN" },
  alarm = { "The actuator has an alarm", "WARN" },
})

-- Reading packets ---------------------------------------------------------------------------------

-- The two bytes after the data, if they are zeros or the CRC and the end byte follows.
local function is_crc_and_end(raw, data, at)
  local low, high, tail = raw:byte(at, at + 2)
  if tail ~= TAIL then return false end
  return low + high == 0 or low_first(low, high) == crc_of(data)
end

-- The packet at a place, with the rules that it breaks: `fault` is the first one. A `quick` look
-- computes no CRC if the end is wrong.
local function read(raw, at, kind, quick)
  local packet, broken = packet_at(raw, at)
  local left = packet.size
  if left < PREFIX then broken("truncated") return packet end
  local _, address, command, high, low = raw:byte(at, at + PREFIX - 1)
  packet.address, packet.command, packet.length = address, command, low_first(low, high)
  packet.stop = at + PREFIX + packet.length -- after the data
  if left < PREFIX + packet.length then broken("truncated") return packet end

  local data = raw:sub(at + PREFIX, packet.stop - 1)
  local least = kind == "request" and CRC_FROM.request or CRC_FROM.reply
  local short_reply = kind == "reply" and #data > 0 and #data < least
  local has_crc = #data >= least
  local ends_here = raw:byte(packet.stop) == TAIL and not CRC_MAY[command]
  if short_reply and not ends_here and is_crc_and_end(raw, data, packet.stop) then
    packet.has_crc, packet.needless = true, not CRC_MAY[command]
    if packet.needless then broken("tail") end
  else
    packet.has_crc = has_crc
  end
  local tail = packet.stop + (packet.has_crc and 2 or 0)
  if tail > #raw then broken("truncated") return packet end
  packet.size = tail + 1 - at
  packet.tail = raw:byte(tail)
  if packet.tail ~= TAIL then broken("tail") end
  if packet.has_crc and not (quick and packet.fault) then
    packet.crc, packet.right_crc = low_first(raw:byte(packet.stop, packet.stop + 1)), crc_of(data)
    if has_crc and packet.crc ~= packet.right_crc then broken("crc") end
  end
  return packet
end

-- The next packet, or bytes to skip. A damaged packet ends where a valid one begins.
local function next_part(raw, at, kind)
  local header = raw:find(HEADER, at, true) or #raw + 1
  if header > at then return skip(at, header) end
  local packet = read(raw, at, kind)
  if not packet.fault then return packet end
  local function find(from) return (raw:find(HEADER, from, true)) end
  local function is_good(inside) return not read(raw, inside, kind, true).fault end
  return end_at_good(packet, find, is_good)
end

-- Showing packets -----------------------------------------------------------------------------------

-- What the data say, if the command has data of this size in this direction.
local function show_value(tree, packet, kind, range)
  local row = COMMANDS[packet.command]
  if not row then return tree:add_proto_expert_info(experts.command) end
  local sizes = kind == "request" and { row.request } or row.reply
  local fits = false
  for _, size in ipairs(sizes) do fits = fits or size == packet.length end
  if not fits then return tree:add_proto_expert_info(experts.data) end
  local format = row.format
  if (kind == "reply") ~= (row.operation == "read") then format = kind == "reply" and "flag" or nil end
  if not format or not range then return end

  if format == "flag" then
    local item = tree:add(f.flag, range)
    if not FLAGS[range:uint()] then item:add_proto_expert_info(experts.value) end
  elseif format == "mode" then
    local item = tree:add(f.mode, range)
    if not MODES[range:uint()] then item:add_proto_expert_info(experts.value) end
  elseif format == "alarms" then
    local item = tree:add(f.alarms, range)
    for _, field in ipairs(alarm_bits) do item:add(field, range) end
    item:add(f.other_alarm, range)
    if range:uint() ~= 0 then item:add_proto_expert_info(experts.alarm) end
  elseif FRACTION_BITS[format] or row.factor then
    local one = row.factor or 2 ^ FRACTION_BITS[format]
    local item = tree:add(f.number, range, range:int() / one)
    if row.full_scale then
      item:append_text(" of the model's full scale (" .. row.unit .. ")")
    elseif row.unit then
      item:append_text(" " .. row.unit)
    end
  end
end

-- Requests and their replies: the last request of each command on each line, and what was found of
-- each packet.
local last, found

function proto.init() last, found = {}, {} end

local function link(tree, packet, kind, pinfo, key)
  local function slot(address) return table.concat({ line_of(pinfo), address, packet.command }, "/") end
  if kind == "request" then
    if not pinfo.visited then
      found[key] = new_request(pinfo)
      last[slot(packet.address)] = found[key]
    end
    if found[key] then show_replies(tree, f, found[key]) end
    return
  end
  -- A device answers a request once, be it to the device or to all.
  local request = last[slot(packet.address)]
  if not request or request.answered[packet.address] then request = last[slot(BROADCAST)] end
  if not pinfo.visited and request and not request.answered[packet.address] then
    add_reply(request, packet.address, pinfo)
    found[key] = request
  end
  if found[key] then show_request(tree, f, found[key], pinfo) end
end

-- Shows a packet, and returns what it is in a few words.
local function show(tree, packet, kind, tvb, pinfo)
  local at = packet.at - 1
  tree:add(f.header, tvb(at, 1))
  tree:add(f.kind, kind):set_generated()
  for _, rule in ipairs(packet.faults) do tree:add_proto_expert_info(experts[rule]) end
  if packet.needless then tree:add_proto_expert_info(experts.needless_crc) end
  local summary = "damaged packet"
  if packet.command and packet.size >= PREFIX then
    local name = command_names[packet.command] or ("command 0x%02X"):format(packet.command)
    summary = name .. (kind == "request" and ", request to " or ", reply of ") .. packet.address
    tree:add(f.address, tvb(at + 1, 1)):append_text(packet.address == BROADCAST and " (all, or the board)" or "")
    tree:add(f.command, tvb(at + 2, 1))
    tree:add(f.length, tvb(at + 3, 2))
    local stop = math.min(packet.stop - 1, at + packet.size)
    local range = stop > at + PREFIX and tvb(at + PREFIX, stop - at - PREFIX)
    if range then tree:add(f.data, range) end
    if not packet.fault then
      show_value(tree, packet, kind, range)
      link(tree, packet, kind, pinfo, place(tvb, pinfo, at))
    end
  end
  local zeros = packet.crc == 0 and CRC_MAY[packet.command] and " (zeros, which this reply may have)"
  show_crc(tree, f, tvb, packet, zeros)
  if packet.tail and not packet.overtaken then tree:add(f.tail, tvb(at + packet.size - 1, 1)) end
  return summary
end

-- A packet does not state its direction: what goes to the board's port is a request. If both ends
-- use that port, the address of the board as delivered decides.
local function direction_of(pinfo)
  if pinfo.src_port ~= pinfo.dst_port then
    return pinfo.dst_port == pinfo.match_uint and "request" or "reply"
  end
  return tostring(pinfo.src) == UDP.address and "reply" or "request"
end

local wire = { name = "INNFOS", proto = proto, fields = f, experts = experts }

function proto.dissector(tvb, pinfo, root)
  local kind = direction_of(pinfo)
  return show_packets(wire, tvb, pinfo, root,
    function(raw, at) return next_part(raw, at, kind) end,
    function(tree, packet) return show(tree, packet, kind, tvb, pinfo) end)
end
DissectorTable.get("udp.port"):add(UDP.port, proto)
