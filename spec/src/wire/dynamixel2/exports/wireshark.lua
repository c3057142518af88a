
local proto = Proto("dynamixel2", TITLE)
local crc_of = crc_function(CRC)
local START = HEADER:sub(1, -2) -- without the reserved byte
local PREFIX = #HEADER + 3      -- with ID and length

-- Fields ----------------------------------------------------------------------------------------

local error_names, instruction_names = { [0] = "None" }, { [STATUS.instruction] = "Status" }
for number, name in pairs(STATUS.errors) do error_names[number] = name end
for code, row in pairs(INSTRUCTIONS) do instruction_names[code] = row.name end

local f = common_fields("dynamixel2")
f.header = ProtoField.bytes("dynamixel2.header", "Header")
f.id = ProtoField.uint8("dynamixel2.id", "ID")
f.length = ProtoField.uint16("dynamixel2.length", "Length")
f.instruction = ProtoField.uint8("dynamixel2.instruction", "Instruction", base.HEX, instruction_names)
f.error = ProtoField.uint8("dynamixel2.error", "Error", base.HEX)
f.alert = ProtoField.bool("dynamixel2.error.alert", "Alert", 8, nil, STATUS.alert)
f.number = ProtoField.uint8("dynamixel2.error.number", "Error number", base.HEX, error_names, 0xFF - STATUS.alert)
f.parameters = ProtoField.bytes("dynamixel2.parameters", "Parameters")
f.other = ProtoField.bytes("dynamixel2.register.other", "Bytes of no whole register")

-- The fields of parameters and of a fast status packet's blocks, by prefix and name.
local layout_fields = {}
local function add_layout_fields(prefix, layout)
  for _, field in ipairs(layout or {}) do
    local key = prefix .. filter_name(field.name)
    if field.each then
      add_layout_fields(prefix, field.each)
    elseif not layout_fields[key] then
      local kind = ({ "uint8", "uint16" })[field.size] or "bytes"
      local show = kind == "bytes" and base.SPACE or field.name == "CRC" and base.HEX or base.DEC
      local title = field.name == "id" and "ID" or field.name:gsub("^%l", string.upper)
      layout_fields[key] = ProtoField[kind]("dynamixel2." .. key, title, show)
      f[key] = layout_fields[key]
    end
  end
end
for _, row in pairs(INSTRUCTIONS) do
  add_layout_fields("param.", row.parameters)
  add_layout_fields("param.", row.status)
  add_layout_fields("block.", row.fast_status)
end

-- The registers of each device, by address, with a field each, and one for each of their bits.
for _, device in ipairs(DEVICES) do
  device.at = {}
  for _, row in ipairs(device.registers) do
    local key = filter_name(device.id) .. "." .. filter_name(row.name)
    row.field = ProtoField[row.type]("dynamixel2." .. key, row.name, base.DEC, row.values)
    f[key] = row.field
    for _, bits in ipairs(row.bits or {}) do
      local kind, bit_key = "uint" .. 8 * row.size, key .. "." .. filter_name(bits.name)
      bits.field = ProtoField[kind]("dynamixel2." .. bit_key, bits.name, base.DEC, bits.values, bits.mask)
      f[bit_key] = bits.field
    end
    device.at[row.address] = row
  end
end
proto.fields = f

local experts = add_experts(proto, {
  header = { "No packet begins here", "WARN" },
  reserved = { "The reserved byte is wrong", "ERROR" },
  id = { "No packet may have this ID", "ERROR" },
  length = { "No packet may have this length", "ERROR" },
  truncated = { "The packet is shorter than its length says", "ERROR" },
  crc = { "The CRC is wrong", "ERROR" },
  stuffing = { "The body has FF FF FD without stuffing", "ERROR" },
  instruction = { "Unknown instruction", "WARN" },
  parameters = { "The parameters do not fit the instruction", "WARN" },
  to_one = { "This instruction may be sent to the broadcast ID only", "WARN" },
  alert = { "The device has a hardware error", "WARN" },
  error = { "The device reports an error", "NOTE" },
  error_number = { "Unknown error number", "WARN" },
  data = { "The data do not have the size that was asked for", "WARN" },
  device = { "No answer of this device was asked for here", "WARN" },
})

local none = { { 1, "none", 0 } }
for index, device in ipairs(DEVICES) do none[index + 1] = { index + 1, device.id, index } end
proto.prefs.device = Pref.enum("Device", 0, "The control table whose registers are shown", none)

-- Reading packets ---------------------------------------------------------------------------------

-- A body without its stuffing, or nil if the pattern has none. Of an `open` body more may come.
local function unstuff(body, open)
  local parts, from = {}, 1
  while true do
    local first, last = body:find(STUFFING.pattern, from, true)
    if not first or open and last == #body then break end
    if body:sub(last + 1, last + 1) ~= STUFFING.insert then return nil end
    parts[#parts + 1] = body:sub(from, last)
    from = last + 2
  end
  return table.concat(parts) .. body:sub(from)
end

-- The packet at a place, with the rules that it breaks: `fault` is the first one. A `quick` look
-- computes no CRC if the stuffing is wrong.
local function read(raw, at, quick)
  local packet, broken = packet_at(raw, at)
  local left = packet.size
  if raw:sub(at, at + #HEADER - 1) ~= HEADER:sub(1, left) then broken("header") end
  if left < PREFIX then broken("truncated") return packet end

  local id, low, high = raw:byte(at + #HEADER, at + PREFIX - 1)
  packet.id, packet.length = id, low_first(low, high)
  packet.size = math.min(left, PREFIX + packet.length)
  if (id < ID.min or id > ID.max) and id ~= ID.broadcast then broken("id") end
  if packet.length < LENGTH_MINIMUM then broken("length") return packet end

  packet.stop = at + PREFIX + packet.length - 2 -- the CRC's place
  local open = left < PREFIX + packet.length
  local stuffed = raw:sub(at + PREFIX, packet.stop - 1)
  packet.code = stuffed:byte(1)
  packet.is_status = packet.code == STATUS.instruction
  packet.is_fast = packet.is_status and id == ID.broadcast -- which is not stuffed
  packet.body = packet.is_fast and stuffed or unstuff(stuffed, open)
  if quick and not packet.body then broken("stuffing") return packet end

  if open then
    broken("truncated")
  else
    packet.crc = low_first(raw:byte(packet.stop, packet.stop + 1))
    packet.right_crc = crc_of(raw:sub(at, packet.stop - 1))
    if packet.crc ~= packet.right_crc then broken("crc") end
  end
  if not packet.body then broken("stuffing") end
  packet.was_stuffed = packet.body and packet.body ~= stuffed
  packet.body = packet.body or stuffed
  if packet.is_status and #packet.body < 2 and not open then broken("length") end
  return packet
end

-- Where the next header is, from a place on, or a whole packet whose only fault is the reserved byte.
-- Where more bytes may come, it may also be the first part of a header at the end.
local function next_header(raw, from, open)
  local at = raw:find(START, from, true)
  while at and at + #START <= #raw do
    if raw:sub(at, at + #HEADER - 1) == HEADER then return at end
    if #read(raw, at, true).faults == 1 then return at, "reserved" end
    at = raw:find(START, at + 1, true)
  end
  for size = open and #HEADER - 1 or 0, 1, -1 do
    if #raw - size + 1 >= from and raw:sub(-size) == HEADER:sub(1, size) then return #raw - size + 1 end
  end
  return #raw + 1
end

-- Whether more bytes may make a packet whole.
local function is_open(packet) return packet.fault == "truncated" and #packet.faults == 1 end

-- The next packet, or bytes to skip. A damaged packet ends where a valid one begins, or one that may
-- become valid.
local function next_part(raw, at, open)
  local header, reserved = next_header(raw, at, open)
  if HEADER:sub(1, #raw - at + 1) == raw:sub(at) then header = at end
  if header > at then return skip(at, header) end
  local packet = read(raw, at)
  packet.reserved = reserved
  if not packet.fault or reserved then return packet end
  local may_be_open = open and not is_open(packet)
  local function find(from) return (next_header(raw, from, open)) end
  local function is_good(inside)
    local other = read(raw, inside, true)
    return not other.fault or may_be_open and is_open(other)
  end
  return end_at_good(packet, find, is_good)
end

-- Showing packets -----------------------------------------------------------------------------------

-- Adds the registers in some bytes, if a device was chosen.
local function add_registers(tree, address, range)
  local device = DEVICES[proto.prefs.device]
  if not device or not address then return end
  local at = 0
  while at < range:len() do
    local row = device.at[address + at]
    if row and at + row.size <= range:len() then
      local bytes = range:range(at, row.size)
      local item = tree:add_le(row.field, bytes)
      if row.unit then
        local number = row.type:sub(1, 1) == "i" and bytes:le_int() or bytes:le_uint()
        local factor, symbol = row.unit[1], row.unit[2]
        local quantity = factor ~= 1 and (" = %.10g"):format(number * factor) or ""
        item:append_text(quantity .. " " .. symbol)
      end
      for _, bits in ipairs(row.bits or {}) do item:add_le(bits.field, bytes) end
      at = at + row.size
    else
      local from = at
      repeat at = at + 1 until at >= range:len() or device.at[address + at]
      local item = tree:add(f.other, range:range(from, at - from))
      item:append_text((" at %d of %s"):format(address + from, device.title))
    end
  end
end

-- Adds an error byte. Returns whether it says that there is none.
local function add_error(tree, range)
  local item = tree:add(f.error, range)
  local number = bit.band(range:uint(), 0xFF - STATUS.alert)
  item:add(f.alert, range)
  item:add(f.number, range)
  if number ~= range:uint() then item:add_proto_expert_info(experts.alert) end
  if number == 0 then return true end
  local name = STATUS.errors[number]
  item:append_text(" (" .. (name or "unknown") .. ")")
  item:add_proto_expert_info(name and experts.error or experts.error_number)
  return false
end

-- Adds the fields of a layout, and puts their values into `known`. Returns how many bytes they take;
-- nil if the bytes do not fit.
local function add_layout(tree, prefix, layout, range, known)
  local at = 0
  for _, field in ipairs(layout) do
    local left = range:len() - at
    if field.optional and left == 0 then break end
    if field.each then
      if left == 0 then return nil end
      while left > 0 do
        local device = setmetatable({}, { __index = known })
        local branch = tree:add(range:range(at, left), "Device")
        local used = add_layout(branch, prefix, field.each, range:range(at, left), device)
        if not used then return nil end
        branch:set_text("Device " .. device.id):set_len(used)
        known.devices[#known.devices + 1] = device
        at, left = at + used, left - used
      end
    else
      local size = field.size == "rest" and left or known[field.size] or field.size
      if size > left then return nil end
      if field.name == "error" then
        add_error(tree, range:range(at, size))
      elseif size > 0 then
        local bytes = range:range(at, size)
        local item = tree:add_le(layout_fields[prefix .. filter_name(field.name)], bytes)
        if size <= 2 then known[field.name] = bytes:le_uint() end
        local name = field.values and field.values[known[field.name]]
        if name then item:append_text(" (" .. name .. ")") end
        if field.fixed and bytes:raw() ~= field.fixed then
          item:add_proto_expert_info(experts.parameters, "The documents have other bytes here")
        end
        if field.name == "model number" and MODELS[known[field.name]] then
          item:append_text(" (" .. MODELS[known[field.name]] .. ")")
        end
        if field.name == "data" then add_registers(item, known.address, bytes) end
      end
      at = at + size
    end
  end
  return at
end

-- Requests and their replies: the last request on each line, and what was found of each packet.
local last, found, first_seen

function proto.init() last, found, first_seen = {}, {}, nil end

-- Whether a device is expected to answer a request.
local function may_answer(request, id)
  local row = INSTRUCTIONS[request.code]
  if not row then return request.id == id end
  if row.fast_status then return id == ID.broadcast end
  if request.id ~= ID.broadcast then return request.id == id end
  if not row.answers_broadcast then return false end
  for _, device in ipairs(request.known.devices) do
    if device.id == id then return true end
  end
  return #request.known.devices == 0
end

-- What a device was asked for: address and length.
local function asked_of(request, id)
  for _, device in ipairs(request.known.devices) do
    if device.id == id then return device end
  end
  return request.known
end

local function show_instruction(tree, packet, range, pinfo, key)
  local row = INSTRUCTIONS[packet.code]
  local known = { devices = {} }
  if not row then
    tree:add_proto_expert_info(experts.instruction)
  elseif not packet.fault or packet.fault == "crc" then
    local used = add_layout(tree, "param.", row.parameters, range, known)
    if used ~= range:len() then
      tree:add_proto_expert_info(experts.parameters)
      known = { devices = {} } -- who was asked for what is not certain
    end
    if row.broadcast_only and packet.id ~= ID.broadcast then
      tree:add_proto_expert_info(experts.to_one)
    end
  end
  if packet.fault then return end
  if not pinfo.visited then
    local request = new_request(pinfo)
    request.id, request.code, request.known = packet.id, packet.code, known
    found[key], last[line_of(pinfo)] = request, request
  end
  if found[key] then show_replies(tree, f, found[key]) end
end

-- Links a reply with its request. A device answers a request once.
local function link_reply(tree, packet, pinfo, key)
  local request = last[line_of(pinfo)]
  if not pinfo.visited and request and may_answer(request, packet.id) and not request.answered[packet.id] then
    add_reply(request, packet.id, pinfo)
    found[key] = request
  end
  request = found[key]
  if request then show_request(tree, f, request, pinfo) end
  return request
end

local function show_status(tree, packet, range, pinfo, key)
  local request = not packet.fault and link_reply(tree, packet, pinfo, key)
  local row = request and INSTRUCTIONS[request.code]
  if not row or not row.status or not packet.good then return "" end
  local asked = asked_of(request, packet.id)
  local known = { devices = {}, address = asked.address }
  local used = add_layout(tree, "param.", row.status, range, known)
  local wanted = row.status[1] and row.status[1].size == "rest" and asked.length
  if used ~= range:len() or wanted and wanted ~= range:len() then
    tree:add_proto_expert_info(experts.data)
  end
  return " to " .. row.name
end

-- A fast status packet: a block per device, each with the CRC of everything before.
local function show_fast_status(tree, packet, tvb, raw, pinfo, key)
  local request = not packet.fault and link_reply(tree, packet, pinfo, key)
  local row = request and INSTRUCTIONS[request.code]
  if not row then return "" end
  local asked, size = request.known, 0
  if #asked.devices == 0 then return " to " .. row.name end -- how its blocks are cut is not known
  for _, field in ipairs(row.fast_status) do size = size + (asked[field.size] or field.size) end
  local at = packet.at + PREFIX + 1
  local function broken(rule)
    packet.fault = packet.fault or rule
    tree:add_proto_expert_info(experts[rule])
  end
  if at + #asked.devices * size ~= packet.stop + 2 then broken("length") end
  for _, device in ipairs(asked.devices) do
    if at + size > packet.stop + 2 then break end
    local known = { address = asked.address, length = asked.length, devices = {} }
    local block = tree:add(tvb(at - 1, size), "Block of device " .. raw:byte(at + 1))
    add_layout(block, "block.", row.fast_status, tvb(at - 1, size), known)
    if known.CRC ~= crc_of(raw:sub(packet.at, at + size - 3)) then broken("crc") end
    if known.id ~= device.id then
      packet.fault = packet.fault or "id"
      block:add_proto_expert_info(experts.device)
    end
    at = at + size
  end
  return " to " .. row.name
end

-- Shows a packet, and returns what it is in a few words.
local function show(tree, packet, tvb, raw, pinfo)
  local at = packet.at - 1
  tree:add(f.header, tvb(at, math.min(#HEADER, packet.size)))
  if packet.reserved then tree:add_proto_expert_info(experts.reserved) end
  for _, rule in ipairs(packet.faults) do
    if not (rule == "header" and packet.reserved) then tree:add_proto_expert_info(experts[rule]) end
  end
  local key, summary = place(tvb, pinfo, at), "damaged packet"
  local function has(stop) return packet.size >= stop end
  if packet.id and has(PREFIX) then
    tree:add(f.id, tvb(at + #HEADER, 1)):append_text(packet.id == ID.broadcast and " (broadcast)" or "")
    tree:add_le(f.length, tvb(at + #HEADER + 1, 2))
  end
  if packet.code and has(PREFIX + 1) then
    tree:add(f.instruction, tvb(at + PREFIX, 1))
    local stop = math.min(packet.stop - 1, at + packet.size)
    local stuffed = tvb(at + PREFIX, stop - at - PREFIX)
    local body = stuffed
    if packet.was_stuffed then
      body = ByteArray.new(packet.body, true):tvb("Body without stuffing"):range()
    end
    local first = packet.is_status and not packet.is_fast and 2 or 1
    if first == 2 and body:len() >= 2 then packet.good = add_error(tree, body:range(1, 1)) end
    local range = body:len() > first and body:range(first, body:len() - first)
    if range then tree:add(f.parameters, range) end
    local empty = tvb(at + PREFIX, 0)
    if packet.is_fast then
      summary = "Status of several" .. show_fast_status(tree, packet, tvb, raw, pinfo, key)
    elseif packet.is_status then
      summary = "Status of " .. packet.id .. show_status(tree, packet, range or empty, pinfo, key)
    else
      local name = instruction_names[packet.code] or ("Instruction 0x%02X"):format(packet.code)
      show_instruction(tree, packet, range or empty, pinfo, key)
      summary = name .. (packet.id == ID.broadcast and " to all" or " to " .. packet.id)
    end
  end
  show_crc(tree, f, tvb, packet)
  return summary
end

local wire = { name = "DYNAMIXEL", proto = proto, fields = f, experts = experts }

local function dissect(tvb, pinfo, root)
  local open = pinfo.can_desegment > 0
  local function find(raw, at)
    local packet = next_part(raw, at, open)
    if open and is_open(packet) and not packet.overtaken then
      pinfo.desegment_offset = at - 1
      pinfo.desegment_len = DESEGMENT_ONE_MORE_SEGMENT
      return nil
    end
    return packet
  end
  local function show_one(tree, packet, raw) return show(tree, packet, tvb, raw, pinfo) end
  return show_packets(wire, tvb, pinfo, root, find, show_one)
end
proto.dissector = dissect

-- TCP: a conversation that begins with a header, ID and length of a packet is taken.
proto:register_heuristic("tcp", function(tvb, pinfo, root)
  local raw = tvb:raw()
  if raw:sub(1, #HEADER) ~= HEADER or #raw < PREFIX then return false end
  local packet = read(raw, 1)
  for _, rule in ipairs(packet.faults) do
    if rule == "id" or rule == "length" then return false end
  end
  dissect(tvb, pinfo, root)
  pinfo.conversation = proto
  return true
end)
DissectorTable.get("tcp.port"):add_for_decode_as(proto)
DissectorTable.get("udp.port"):add_for_decode_as(proto)

-- Serial lines: records of the link type USER0 are taken from the first header on. Other records go
-- to the protocol that the user may have chosen for that link type.
local serial = Proto("dynamixel2_serial", TITLE .. " on a serial line")
local encapsulations = DissectorTable.get("wtap_encap")
local user_dlt = Dissector.get("user_dlt")
function serial.dissector(tvb, pinfo, root)
  if not first_seen and tvb:raw():find(HEADER, 1, true) then first_seen = pinfo.number end
  if first_seen and pinfo.number >= first_seen then return dissect(tvb, pinfo, root) end
  return user_dlt:call(tvb, pinfo, root)
end
encapsulations:add(wtap.USER0, serial)
