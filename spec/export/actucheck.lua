-- A dissector for Wireshark and tshark, written by `actucheck spec export wireshark` of version
-- 0.1.0, so do not edit it. Licensed under MIT or Apache-2.0, at your choice.
--
-- Wires: DYNAMIXEL Protocol 2.0 and its JA dialect, filter `dynamixel2`;
--   The INNFOS Ethernet protocol, filter `innfos`.
--
-- To install it, put this file into the folder that Wireshark shows at Help, About Wireshark,
-- Folders, Personal Lua Plugins, then press Ctrl+Shift+L. To try it:
--   tshark -X lua_script:actucheck.lua -r capture.pcapng -V

-- What the wires share ------------------------------------------------------------------------

-- The function that computes a CRC of 16 bits over a string.
local function crc_function(crc)
  local function reversed(number)
    local result = 0
    for _ = 1, 16 do
      result = bit.bor(bit.lshift(result, 1), bit.band(number, 1))
      number = bit.rshift(number, 1)
    end
    return result
  end
  local polynomial = crc.reflected and reversed(crc.polynomial) or crc.polynomial
  local of_byte = {}
  for byte = 0, 255 do
    local value = crc.reflected and byte or bit.lshift(byte, 8)
    for _ = 1, 8 do
      local carry = bit.band(value, crc.reflected and 1 or 0x8000) ~= 0
      value = crc.reflected and bit.rshift(value, 1) or bit.band(bit.lshift(value, 1), 0xFFFF)
      if carry then value = bit.bxor(value, polynomial) end
    end
    of_byte[byte] = value
  end
  local function compute(text)
    local value = crc.initial
    for at = 1, #text do
      if crc.reflected then
        local index = bit.band(bit.bxor(value, text:byte(at)), 0xFF)
        value = bit.bxor(bit.rshift(value, 8), of_byte[index])
      else
        local index = bit.bxor(bit.rshift(value, 8), text:byte(at))
        value = bit.bxor(bit.band(bit.lshift(value, 8), 0xFFFF), of_byte[index])
      end
    end
    return bit.bxor(value, crc.final_xor)
  end
  assert(compute("123456789") == crc.check, "the table of " .. crc.name .. " is wrong")
  return compute
end

-- The number in two bytes whose first one is the low one.
local function low_first(low, high) return low + 256 * high end

-- A name as a part of a filter: `Goal Position` as `goal_position`.
local function filter_name(name) return (name:lower():gsub("[^%w]+", "_")) end

-- Adds an expert info per rule to a protocol. A rule has a text and a severity.
local function add_experts(proto, rules)
  local infos = {}
  for name, rule in pairs(rules) do
    local group = name == "crc" and expert.group.CHECKSUM or expert.group.PROTOCOL
    local abbreviation = proto.name:lower() .. ".expert." .. name
    infos[name] = ProtoExpert.new(abbreviation, rule[1], group, expert.severity[rule[2]])
  end
  proto.experts = infos
  return infos
end

-- The fields that every wire has; three of them link a request with its replies.
local function common_fields(prefix)
  return {
    crc = ProtoField.uint16(prefix .. ".crc", "CRC", base.HEX),
    fault = ProtoField.string(prefix .. ".fault", "First broken rule"),
    skipped = ProtoField.bytes(prefix .. ".skipped", "Bytes that belong to no packet"),
    request_in = ProtoField.framenum(prefix .. ".request_in", "Request in", base.NONE, frametype.REQUEST),
    reply_in = ProtoField.framenum(prefix .. ".reply_in", "Reply in", base.NONE, frametype.RESPONSE),
    time = ProtoField.relative_time(prefix .. ".time", "Time since the request"),
  }
end

-- A packet from a place to the end, and the function that notes a rule that it breaks: `fault` is
-- the first one.
local function packet_at(raw, at)
  local packet = { at = at, size = #raw - at + 1, faults = {} }
  return packet, function(rule)
    packet.fault = packet.fault or rule
    packet.faults[#packet.faults + 1] = rule
  end
end

-- Bytes that belong to no packet.
local function skip(at, stop) return { at = at, size = stop - at, fault = "header", skipped = true } end

-- Ends a damaged packet at the first place inside it that `is_good`, of those that `find` finds.
local function end_at_good(packet, find, is_good)
  local inside = find(packet.at + 1)
  while inside and inside < packet.at + packet.size do
    if is_good(inside) then
      packet.size, packet.overtaken = inside - packet.at, true
      break
    end
    inside = find(inside + 1)
  end
  return packet
end

-- Where a packet is in the capture. Frames are read in order first and in any order later, so what
-- was found the first time is kept by this place.
local function place(tvb, pinfo, at)
  return table.concat({ pinfo.number, tvb:offset() + at, tvb:len() }, ":")
end

-- Both ends of a conversation, the same in either direction; on a serial line, the line.
local interface_id = Field.new("frame.interface_id")
local function line_of(pinfo)
  local from = tostring(pinfo.src) .. ":" .. pinfo.src_port
  local to = tostring(pinfo.dst) .. ":" .. pinfo.dst_port
  if to < from then from, to = to, from end
  local interface = interface_id()
  return from .. "|" .. to .. "|" .. (interface and tostring(interface.value) or "")
end

-- A request that no device has answered yet.
local function new_request(pinfo)
  return { frame = pinfo.number, time = pinfo.rel_ts, replies = {}, answered = {} }
end

-- Notes the reply of a device, which answers a request once.
local function add_reply(request, id, pinfo)
  request.answered[id] = true
  request.replies[#request.replies + 1] = pinfo.number
end

-- Shows in which frames a request is answered. A later pass knows; the first one does not.
local function show_replies(tree, fields, request)
  for _, frame in ipairs(request.replies) do
    tree:add(fields.reply_in, frame):set_generated()
  end
end

-- Shows which request a reply answers, and how long that took.
local function show_request(tree, fields, request, pinfo)
  tree:add(fields.request_in, request.frame):set_generated()
  local seconds = pinfo.rel_ts - request.time
  local whole = math.floor(seconds)
  local rest = math.floor((seconds - whole) * 1e9 + 0.5)
  tree:add(fields.time, NSTime.new(whole, rest)):set_generated()
end

-- Shows the CRC of a packet. `exception` is why another one is right too, if it is.
local function show_crc(tree, fields, tvb, packet, exception)
  if not packet.crc or packet.overtaken then return end
  local item = tree:add_le(fields.crc, tvb(packet.stop - 1, 2))
  local right = packet.crc == packet.right_crc and " (right)" or exception
  item:append_text(right or (" (wrong, 0x%04x is right)"):format(packet.right_crc))
end

-- Shows the packets of some bytes, up to where `find` finds none, and writes the columns of the packet
-- list. `show` says what a packet is in a few words.
local function show_packets(wire, tvb, pinfo, root, find, show)
  local raw, at, summaries = tvb:raw(), 1, {}
  while at <= #raw do
    local packet = find(raw, at)
    if not packet then break end
    local tree = root:add(wire.proto, tvb(at - 1, packet.size))
    local summary
    if packet.skipped then
      tree:add(wire.fields.skipped, tvb(at - 1, packet.size))
      tree:add_proto_expert_info(wire.experts.header)
      tree:append_text(": skipped")
      summary = packet.size .. (packet.size == 1 and " byte" or " bytes") .. " skipped"
    else
      summary = show(tree, packet, raw)
      if packet.fault then summary = summary .. " [" .. packet.fault .. "]" end
      tree:append_text(": " .. summary)
    end
    if packet.fault then tree:add(wire.fields.fault, packet.fault):set_generated() end
    summaries[#summaries + 1] = summary
    at = at + packet.size
  end
  if #summaries > 0 then
    pinfo.cols.protocol = wire.name
    pinfo.cols.info = table.concat(summaries, "; ")
  end
  return #raw
end

-- DYNAMIXEL Protocol 2.0 and its JA dialect -------------------------------------------------

do
-- Found in records of the link type USER0 (147), which serial lines have, from the first header on,
-- and in TCP conversations that begin with a packet. For another link type choose `dynamixel2` at
-- Preferences, Protocols, DLT_USER; for a port use Decode As. A hex dump becomes a capture with
--   text2pcap -l 147 dump.txt capture.pcap
-- Registers have names only if their device is chosen, at Preferences, Protocols, DYNAMIXEL2, or
--   tshark -o dynamixel2.device:ja40

local TITLE = "DYNAMIXEL Protocol 2.0 and its JA dialect"
local HEADER = "\xFF\xFF\xFD\x00"
local ID = { min = 0, max = 252, broadcast = 254 }
local LENGTH_MINIMUM = 3
local STUFFING = { pattern = "\xFF\xFF\xFD", insert = "\xFD" }
local CRC = {
  name = "CRC-16/UMTS",
  polynomial = 0x8005,
  initial = 0x0000,
  reflected = false,
  final_xor = 0x0000,
  check = 0xFEE8,
}
local STATUS = {
  instruction = 0x55,
  alert = 0x80,
  errors = {
    [0x01] = "Result Fail",
    [0x02] = "Instruction Error",
    [0x03] = "CRC Error",
    [0x04] = "Data Range Error",
    [0x05] = "Data Length Error",
    [0x06] = "Data Limit Error",
    [0x07] = "Access Error",
  },
}
local INSTRUCTIONS = {
  [0x01] = {
    name = "Ping",
    answers_broadcast = true,
    parameters = {},
    status = { { name = "model number", size = 2 }, { name = "firmware version", size = 1 } },
  },
  [0x02] = {
    name = "Read",
    parameters = { { name = "address", size = 2 }, { name = "length", size = 2 } },
    status = { { name = "data", size = "rest" } },
  },
  [0x03] = {
    name = "Write",
    parameters = { { name = "address", size = 2 }, { name = "data", size = "rest" } },
    status = {},
  },
  [0x04] = {
    name = "Reg Write",
    parameters = { { name = "address", size = 2 }, { name = "data", size = "rest" } },
    status = {},
  },
  [0x05] = { name = "Action", parameters = {}, status = {} },
  [0x06] = {
    name = "Factory Reset",
    parameters = {
      {
        name = "option",
        size = 1,
        values = { [255] = "Reset all", [1] = "Reset all except ID", [2] = "Reset all except ID and baud rate" },
      },
    },
    status = {},
  },
  [0x08] = { name = "Reboot", parameters = {}, status = {} },
  [0x10] = {
    name = "Clear",
    parameters = {
      { name = "option", size = 1, optional = true, values = { [1] = "Clear multi-turn information" } },
      { name = "key", size = "rest", fixed = "\x44\x58\x4C\x22" },
    },
    status = {},
  },
  [0x20] = {
    name = "Control Table Backup",
    parameters = {
      { name = "option", size = 1, values = { [1] = "Store", [2] = "Restore" } },
      { name = "key", size = 4, fixed = "\x43\x54\x52\x4C" },
    },
    status = {},
  },
  [0x82] = {
    name = "Sync Read",
    broadcast_only = true,
    answers_broadcast = true,
    parameters = {
      { name = "address", size = 2 },
      { name = "length", size = 2 },
      { name = "devices", each = { { name = "id", size = 1 } } },
    },
    status = { { name = "data", size = "rest" } },
  },
  [0x83] = {
    name = "Sync Write",
    broadcast_only = true,
    parameters = {
      { name = "address", size = 2 },
      { name = "length", size = 2 },
      { name = "devices", each = { { name = "id", size = 1 }, { name = "data", size = "length" } } },
    },
  },
  [0x8A] = {
    name = "Fast Sync Read",
    broadcast_only = true,
    answers_broadcast = true,
    parameters = {
      { name = "address", size = 2 },
      { name = "length", size = 2 },
      { name = "devices", each = { { name = "id", size = 1 } } },
    },
    fast_status = {
      { name = "error", size = 1 },
      { name = "id", size = 1 },
      { name = "data", size = "length" },
      { name = "CRC", size = 2 },
    },
  },
  [0x8B] = {
    name = "Fast Sync Write",
    broadcast_only = true,
    answers_broadcast = true,
    parameters = {
      { name = "address", size = 2 },
      { name = "length", size = 2 },
      { name = "devices", each = { { name = "id", size = 1 }, { name = "data", size = "length" } } },
    },
    fast_status = { { name = "error", size = 1 }, { name = "id", size = 1 }, { name = "CRC", size = 2 } },
  },
  [0x92] = {
    name = "Bulk Read",
    broadcast_only = true,
    answers_broadcast = true,
    parameters = {
      {
        name = "devices",
        each = { { name = "id", size = 1 }, { name = "address", size = 2 }, { name = "length", size = 2 } },
      },
    },
    status = { { name = "data", size = "rest" } },
  },
  [0x93] = {
    name = "Bulk Write",
    broadcast_only = true,
    parameters = {
      {
        name = "devices",
        each = {
          { name = "id", size = 1 },
          { name = "address", size = 2 },
          { name = "length", size = 2 },
          { name = "data", size = "length" },
        },
      },
    },
  },
}
local MODELS = { [5210] = "JA40", [1200] = "XL330-M288", [1030] = "XM430-W210" }
local DEVICES = {
  {
    id = "ja-variant",
    title = "JA variant",
    registers = {
      { address = 0, name = "Model Number", type = "uint16", size = 2 },
      { address = 6, name = "Firmware Version", type = "uint8", size = 1 },
      { address = 7, name = "ID", type = "uint8", size = 1 },
      {
        address = 8,
        name = "Baud Rate",
        type = "uint8",
        size = 1,
        values = { [0] = "9,600 bps", [1] = "57,600 bps", [2] = "115,200 bps", [3] = "1 Mbps", [4] = "2 Mbps" },
      },
      {
        address = 10,
        name = "Drive Mode",
        type = "uint8",
        size = 1,
        bits = {
          {
            name = "Reverse Mode",
            mask = 0x01,
            values = { [0] = "Normal (positive is counterclockwise)", [1] = "Reverse (positive is clockwise)" },
          },
          { name = "Enable Profile", mask = 0x02, values = { [0] = "Profile disabled", [1] = "Profile enabled" } },
        },
      },
      {
        address = 11,
        name = "Operating Mode",
        type = "uint8",
        size = 1,
        values = { [4] = "Extended Position Control Mode", [17] = "Calibration Mode" },
      },
      { address = 20, name = "Homing Offset", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 31, name = "Temperature Limit", type = "uint8", size = 1, unit = { 1, "°C" } },
      { address = 36, name = "PWM Limit", type = "uint16", size = 2, unit = { 0.0026, "%" } },
      { address = 44, name = "Velocity Limit", type = "uint32", size = 4, unit = { 0.01, "rev/min" } },
      { address = 48, name = "Max Position Limit", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 52, name = "Min Position Limit", type = "int32", size = 4, unit = { 1, "count" } },
      {
        address = 512,
        name = "Torque Enable",
        type = "uint8",
        size = 1,
        values = { [0] = "Torque off", [1] = "Torque on, EEPROM area locked" },
      },
      {
        address = 518,
        name = "Hardware Error Status",
        type = "uint8",
        size = 1,
        bits = {
          { name = "Overheating Error", mask = 0x04 },
          { name = "Motor Encoder Error", mask = 0x08 },
          { name = "Electrical Shock Error", mask = 0x10 },
          { name = "Overload Error", mask = 0x20 },
          { name = "Position Limit Error", mask = 0x40 },
          { name = "Check EEPROM Area Error", mask = 0x80 },
        },
      },
      { address = 522, name = "Movement Duration", type = "uint16", size = 2, unit = { 1, "ms" } },
      { address = 524, name = "Velocity I Gain", type = "uint16", size = 2 },
      { address = 526, name = "Velocity P Gain", type = "uint16", size = 2 },
      { address = 528, name = "Position D Gain", type = "uint16", size = 2 },
      { address = 530, name = "Position I Gain", type = "uint16", size = 2 },
      { address = 532, name = "Position P Gain", type = "uint16", size = 2 },
      { address = 536, name = "Feedforward 2nd Gain", type = "uint16", size = 2 },
      { address = 538, name = "Feedforward 1st Gain", type = "uint16", size = 2 },
      { address = 564, name = "Goal Position", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 568, name = "Realtime Tick", type = "uint16", size = 2, unit = { 1, "ms" } },
      {
        address = 571,
        name = "Moving Status",
        type = "uint8",
        size = 1,
        bits = {
          { name = "In-Position", mask = 0x01 },
          {
            name = "Profile Type",
            mask = 0x30,
            values = {
              [0] = "Profile unused (step)",
              [1] = "Rectangle velocity profile",
              [3] = "Trapezoidal velocity profile",
            },
          },
        },
      },
      { address = 572, name = "Present PWM", type = "int16", size = 2, unit = { 0.0096, "%" } },
      { address = 576, name = "Present Velocity", type = "int32", size = 4, unit = { 0.0078125, "count/100 us" } },
      { address = 580, name = "Present Position", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 584, name = "Velocity Trajectory", type = "int32", size = 4, unit = { 0.01, "rev/min" } },
      { address = 588, name = "Position Trajectory", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 594, name = "Present Temperature", type = "uint8", size = 1, unit = { 1, "°C" } },
      {
        address = 878,
        name = "Backup Ready",
        type = "uint8",
        size = 1,
        values = { [0] = "No backup", [1] = "Backup stored" },
      },
    },
  },
  {
    id = "ja40",
    title = "JA40",
    registers = {
      { address = 0, name = "Model Number", type = "uint16", size = 2 },
      { address = 2, name = "Model Information", type = "uint32", size = 4 },
      { address = 6, name = "Firmware Version", type = "uint8", size = 1 },
      { address = 7, name = "ID", type = "uint8", size = 1 },
      {
        address = 8,
        name = "Baud Rate",
        type = "uint8",
        size = 1,
        values = { [0] = "9,600 bps", [1] = "57,600 bps", [2] = "115,200 bps", [3] = "1 Mbps", [4] = "2 Mbps" },
      },
      {
        address = 10,
        name = "Drive Mode",
        type = "uint8",
        size = 1,
        bits = {
          {
            name = "Reverse Mode",
            mask = 0x01,
            values = { [0] = "Normal (positive is counterclockwise)", [1] = "Reverse (positive is clockwise)" },
          },
          { name = "Disable Profile", mask = 0x02, values = { [0] = "Profile enabled", [1] = "Profile disabled" } },
          {
            name = "Profile Configuration",
            mask = 0x04,
            values = { [0] = "Velocity-based profile", [1] = "Time-based profile" },
          },
        },
      },
      {
        address = 11,
        name = "Operating Mode",
        type = "uint8",
        size = 1,
        values = {
          [0] = "Current Control Mode",
          [1] = "Velocity Control Mode",
          [3] = "Position Control Mode",
          [4] = "Extended Position Control Mode",
          [17] = "Calibration Mode",
        },
      },
      { address = 20, name = "Homing Offset", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 31, name = "Temperature Limit", type = "uint8", size = 1, unit = { 1, "°C" } },
      { address = 36, name = "PWM Limit", type = "uint16", size = 2, unit = { 0.0026, "%" } },
      { address = 38, name = "Current Limit", type = "uint16", size = 2, unit = { 2.5177, "mA" } },
      { address = 40, name = "Acceleration Limit", type = "uint32", size = 4, unit = { 1, "rev/min²" } },
      { address = 44, name = "Velocity Limit", type = "uint32", size = 4, unit = { 0.01, "rev/min" } },
      { address = 48, name = "Max Position Limit", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 52, name = "Min Position Limit", type = "int32", size = 4, unit = { 1, "count" } },
      {
        address = 512,
        name = "Torque Enable",
        type = "uint8",
        size = 1,
        values = { [0] = "Torque off", [1] = "Torque on, EEPROM area locked" },
      },
      {
        address = 518,
        name = "Hardware Error Status",
        type = "uint8",
        size = 1,
        bits = {
          { name = "Velocity Limit Reached Error", mask = 0x02 },
          { name = "Overheating Error", mask = 0x04 },
          { name = "Encoder Error", mask = 0x08 },
          { name = "Overload Error", mask = 0x20 },
          { name = "Position Limit Reached Error", mask = 0x40 },
          { name = "Check EEPROM Area Error", mask = 0x80 },
        },
      },
      { address = 522, name = "Profile Time", type = "uint16", size = 2, unit = { 1, "ms" } },
      { address = 524, name = "Velocity I Gain", type = "uint16", size = 2 },
      { address = 526, name = "Velocity P Gain", type = "uint16", size = 2 },
      { address = 528, name = "Position D Gain", type = "uint16", size = 2 },
      { address = 530, name = "Position I Gain", type = "uint16", size = 2 },
      { address = 532, name = "Position P Gain", type = "uint16", size = 2 },
      { address = 536, name = "Feedforward 2nd Gain", type = "uint16", size = 2 },
      { address = 538, name = "Feedforward 1st Gain", type = "uint16", size = 2 },
      { address = 550, name = "Goal Current", type = "int16", size = 2, unit = { 2.5177, "mA" } },
      { address = 552, name = "Goal Velocity", type = "int32", size = 4, unit = { 0.01, "rev/min" } },
      { address = 556, name = "Profile Acceleration", type = "uint32", size = 4 },
      { address = 560, name = "Profile Velocity", type = "uint32", size = 4 },
      { address = 564, name = "Goal Position", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 568, name = "Realtime Tick", type = "uint16", size = 2, unit = { 1, "ms" } },
      {
        address = 571,
        name = "Moving Status",
        type = "uint8",
        size = 1,
        bits = {
          { name = "In-Position", mask = 0x01 },
          {
            name = "Profile Type",
            mask = 0x30,
            values = {
              [0] = "Profile unused (step)",
              [1] = "Rectangle velocity profile",
              [3] = "Trapezoidal velocity profile",
            },
          },
        },
      },
      { address = 572, name = "Present PWM", type = "int16", size = 2, unit = { 0.0096, "%" } },
      { address = 574, name = "Present Current", type = "int16", size = 2, unit = { 2.5177, "mA" } },
      { address = 576, name = "Present Velocity", type = "int32", size = 4, unit = { 0.0078125, "count/100 us" } },
      { address = 580, name = "Present Position", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 584, name = "Velocity Trajectory", type = "int32", size = 4, unit = { 0.01, "rev/min" } },
      { address = 588, name = "Position Trajectory", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 594, name = "Present Temperature", type = "uint8", size = 1, unit = { 1, "°C" } },
      {
        address = 878,
        name = "Backup Ready",
        type = "uint8",
        size = 1,
        values = { [0] = "No backup", [1] = "Backup stored" },
      },
    },
  },
  {
    id = "xl330-m288",
    title = "XL330-M288",
    registers = {
      { address = 0, name = "Model Number", type = "uint16", size = 2 },
      { address = 2, name = "Model Information", type = "uint32", size = 4 },
      { address = 6, name = "Firmware Version", type = "uint8", size = 1 },
      { address = 7, name = "ID", type = "uint8", size = 1 },
      {
        address = 8,
        name = "Baud Rate",
        type = "uint8",
        size = 1,
        values = {
          [0] = "9,600 bps",
          [1] = "57,600 bps",
          [2] = "115,200 bps",
          [3] = "1 Mbps",
          [4] = "2 Mbps",
          [5] = "3 Mbps",
          [6] = "4 Mbps",
        },
      },
      { address = 9, name = "Return Delay Time", type = "uint8", size = 1, unit = { 2, "µs" } },
      {
        address = 10,
        name = "Drive Mode",
        type = "uint8",
        size = 1,
        bits = {
          {
            name = "Reverse Mode",
            mask = 0x01,
            values = { [0] = "Normal (positive is counterclockwise)", [1] = "Reverse (positive is clockwise)" },
          },
          {
            name = "Profile Configuration",
            mask = 0x04,
            values = { [0] = "Velocity-based profile", [1] = "Time-based profile" },
          },
          {
            name = "Torque On by Goal Update",
            mask = 0x08,
            values = { [0] = "A goal does not turn torque on", [1] = "A goal turns torque on" },
          },
        },
      },
      {
        address = 11,
        name = "Operating Mode",
        type = "uint8",
        size = 1,
        values = {
          [0] = "Current Control Mode",
          [1] = "Velocity Control Mode",
          [3] = "Position Control Mode",
          [4] = "Extended Position Control Mode",
          [5] = "Current-based Position Mode",
          [16] = "PWM Control Mode",
        },
      },
      { address = 12, name = "Secondary(Shadow) ID", type = "uint8", size = 1 },
      {
        address = 13,
        name = "Protocol Type",
        type = "uint8",
        size = 1,
        values = { [2] = "DYNAMIXEL Protocol 2.0", [20] = "S.BUS", [21] = "iBUS", [22] = "RC-PWM" },
      },
      { address = 20, name = "Homing Offset", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 24, name = "Moving Threshold", type = "uint32", size = 4, unit = { 0.229, "rev/min" } },
      { address = 31, name = "Temperature Limit", type = "uint8", size = 1, unit = { 1, "°C" } },
      { address = 32, name = "Max Voltage Limit", type = "uint16", size = 2, unit = { 0.1, "V" } },
      { address = 34, name = "Min Voltage Limit", type = "uint16", size = 2, unit = { 0.1, "V" } },
      { address = 36, name = "PWM Limit", type = "uint16", size = 2, unit = { 0.113, "%" } },
      { address = 38, name = "Current Limit", type = "uint16", size = 2, unit = { 1, "mA" } },
      { address = 44, name = "Velocity Limit", type = "uint32", size = 4, unit = { 0.229, "rev/min" } },
      { address = 48, name = "Max Position Limit", type = "uint32", size = 4, unit = { 1, "count" } },
      { address = 52, name = "Min Position Limit", type = "uint32", size = 4, unit = { 1, "count" } },
      {
        address = 60,
        name = "Startup Configuration",
        type = "uint8",
        size = 1,
        bits = { { name = "Startup Torque On", mask = 0x01 }, { name = "RAM Restore", mask = 0x02 } },
      },
      { address = 62, name = "PWM Slope", type = "uint8", size = 1, unit = { 1.977, "mV/ms" } },
      {
        address = 63,
        name = "Shutdown",
        type = "uint8",
        size = 1,
        bits = {
          { name = "Input Voltage Error", mask = 0x01 },
          { name = "Overheating Error", mask = 0x04 },
          { name = "Electrical Shock Error", mask = 0x10 },
          { name = "Overload Error", mask = 0x20 },
        },
      },
      {
        address = 64,
        name = "Torque Enable",
        type = "uint8",
        size = 1,
        values = { [0] = "Torque off", [1] = "Torque on, EEPROM area locked" },
      },
      { address = 65, name = "LED", type = "uint8", size = 1, values = { [0] = "LED off", [1] = "LED on" } },
      {
        address = 68,
        name = "Status Return Level",
        type = "uint8",
        size = 1,
        values = { [0] = "Answers Ping", [1] = "Answers Ping and Read", [2] = "Answers all instructions" },
      },
      {
        address = 69,
        name = "Registered Instruction",
        type = "uint8",
        size = 1,
        values = { [0] = "No instruction registered", [1] = "Instruction registered" },
      },
      {
        address = 70,
        name = "Hardware Error Status",
        type = "uint8",
        size = 1,
        bits = {
          { name = "Input Voltage Error", mask = 0x01 },
          { name = "Overheating Error", mask = 0x04 },
          { name = "Electrical Shock Error", mask = 0x10 },
          { name = "Overload Error", mask = 0x20 },
        },
      },
      { address = 76, name = "Velocity I Gain", type = "uint16", size = 2 },
      { address = 78, name = "Velocity P Gain", type = "uint16", size = 2 },
      { address = 80, name = "Position D Gain", type = "uint16", size = 2 },
      { address = 82, name = "Position I Gain", type = "uint16", size = 2 },
      { address = 84, name = "Position P Gain", type = "uint16", size = 2 },
      { address = 88, name = "Feedforward 2nd Gain", type = "uint16", size = 2 },
      { address = 90, name = "Feedforward 1st Gain", type = "uint16", size = 2 },
      { address = 98, name = "Bus Watchdog", type = "int8", size = 1, unit = { 20, "ms" } },
      { address = 100, name = "Goal PWM", type = "int16", size = 2, unit = { 0.113, "%" } },
      { address = 102, name = "Goal Current", type = "int16", size = 2, unit = { 1, "mA" } },
      { address = 104, name = "Goal Velocity", type = "int32", size = 4, unit = { 0.229, "rev/min" } },
      { address = 108, name = "Profile Acceleration", type = "uint32", size = 4 },
      { address = 112, name = "Profile Velocity", type = "uint32", size = 4 },
      { address = 116, name = "Goal Position", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 120, name = "Realtime Tick", type = "uint16", size = 2, unit = { 1, "ms" } },
      {
        address = 122,
        name = "Moving",
        type = "uint8",
        size = 1,
        values = { [0] = "Movement not detected", [1] = "Movement detected or profile in progress" },
      },
      {
        address = 123,
        name = "Moving Status",
        type = "uint8",
        size = 1,
        bits = {
          { name = "In-Position", mask = 0x01 },
          { name = "Profile Ongoing", mask = 0x02 },
          { name = "Following Error", mask = 0x08 },
          {
            name = "Profile Type",
            mask = 0x30,
            values = {
              [0] = "Profile unused (step)",
              [1] = "Rectangle velocity profile",
              [2] = "Triangle velocity profile",
              [3] = "Trapezoidal velocity profile",
            },
          },
        },
      },
      { address = 124, name = "Present PWM", type = "int16", size = 2, unit = { 0.113, "%" } },
      { address = 126, name = "Present Current", type = "int16", size = 2, unit = { 1, "mA" } },
      { address = 128, name = "Present Velocity", type = "int32", size = 4, unit = { 0.229, "rev/min" } },
      { address = 132, name = "Present Position", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 136, name = "Velocity Trajectory", type = "int32", size = 4, unit = { 0.229, "rev/min" } },
      { address = 140, name = "Position Trajectory", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 144, name = "Present Input Voltage", type = "uint16", size = 2, unit = { 0.1, "V" } },
      { address = 146, name = "Present Temperature", type = "uint8", size = 1, unit = { 1, "°C" } },
      {
        address = 147,
        name = "Backup Ready",
        type = "uint8",
        size = 1,
        values = { [0] = "No backup", [1] = "Backup exists" },
      },
      { address = 168, name = "Indirect Address 1", type = "uint16", size = 2 },
      { address = 170, name = "Indirect Address 2", type = "uint16", size = 2 },
      { address = 172, name = "Indirect Address 3", type = "uint16", size = 2 },
      { address = 174, name = "Indirect Address 4", type = "uint16", size = 2 },
      { address = 176, name = "Indirect Address 5", type = "uint16", size = 2 },
      { address = 178, name = "Indirect Address 6", type = "uint16", size = 2 },
      { address = 180, name = "Indirect Address 7", type = "uint16", size = 2 },
      { address = 182, name = "Indirect Address 8", type = "uint16", size = 2 },
      { address = 184, name = "Indirect Address 9", type = "uint16", size = 2 },
      { address = 186, name = "Indirect Address 10", type = "uint16", size = 2 },
      { address = 188, name = "Indirect Address 11", type = "uint16", size = 2 },
      { address = 190, name = "Indirect Address 12", type = "uint16", size = 2 },
      { address = 192, name = "Indirect Address 13", type = "uint16", size = 2 },
      { address = 194, name = "Indirect Address 14", type = "uint16", size = 2 },
      { address = 196, name = "Indirect Address 15", type = "uint16", size = 2 },
      { address = 198, name = "Indirect Address 16", type = "uint16", size = 2 },
      { address = 200, name = "Indirect Address 17", type = "uint16", size = 2 },
      { address = 202, name = "Indirect Address 18", type = "uint16", size = 2 },
      { address = 204, name = "Indirect Address 19", type = "uint16", size = 2 },
      { address = 206, name = "Indirect Address 20", type = "uint16", size = 2 },
      { address = 208, name = "Indirect Address 21", type = "uint16", size = 2 },
      { address = 210, name = "Indirect Address 22", type = "uint16", size = 2 },
      { address = 212, name = "Indirect Address 23", type = "uint16", size = 2 },
      { address = 214, name = "Indirect Address 24", type = "uint16", size = 2 },
      { address = 216, name = "Indirect Address 25", type = "uint16", size = 2 },
      { address = 218, name = "Indirect Address 26", type = "uint16", size = 2 },
      { address = 220, name = "Indirect Address 27", type = "uint16", size = 2 },
      { address = 222, name = "Indirect Address 28", type = "uint16", size = 2 },
      { address = 224, name = "Indirect Data 1", type = "uint8", size = 1 },
      { address = 225, name = "Indirect Data 2", type = "uint8", size = 1 },
      { address = 226, name = "Indirect Data 3", type = "uint8", size = 1 },
      { address = 227, name = "Indirect Data 4", type = "uint8", size = 1 },
      { address = 228, name = "Indirect Data 5", type = "uint8", size = 1 },
      { address = 229, name = "Indirect Data 6", type = "uint8", size = 1 },
      { address = 230, name = "Indirect Data 7", type = "uint8", size = 1 },
      { address = 231, name = "Indirect Data 8", type = "uint8", size = 1 },
      { address = 232, name = "Indirect Data 9", type = "uint8", size = 1 },
      { address = 233, name = "Indirect Data 10", type = "uint8", size = 1 },
      { address = 234, name = "Indirect Data 11", type = "uint8", size = 1 },
      { address = 235, name = "Indirect Data 12", type = "uint8", size = 1 },
      { address = 236, name = "Indirect Data 13", type = "uint8", size = 1 },
      { address = 237, name = "Indirect Data 14", type = "uint8", size = 1 },
      { address = 238, name = "Indirect Data 15", type = "uint8", size = 1 },
      { address = 239, name = "Indirect Data 16", type = "uint8", size = 1 },
      { address = 240, name = "Indirect Data 17", type = "uint8", size = 1 },
      { address = 241, name = "Indirect Data 18", type = "uint8", size = 1 },
      { address = 242, name = "Indirect Data 19", type = "uint8", size = 1 },
      { address = 243, name = "Indirect Data 20", type = "uint8", size = 1 },
      { address = 244, name = "Indirect Data 21", type = "uint8", size = 1 },
      { address = 245, name = "Indirect Data 22", type = "uint8", size = 1 },
      { address = 246, name = "Indirect Data 23", type = "uint8", size = 1 },
      { address = 247, name = "Indirect Data 24", type = "uint8", size = 1 },
      { address = 248, name = "Indirect Data 25", type = "uint8", size = 1 },
      { address = 249, name = "Indirect Data 26", type = "uint8", size = 1 },
      { address = 250, name = "Indirect Data 27", type = "uint8", size = 1 },
      { address = 251, name = "Indirect Data 28", type = "uint8", size = 1 },
    },
  },
  {
    id = "xm430-w210",
    title = "XM430-W210",
    registers = {
      { address = 0, name = "Model Number", type = "uint16", size = 2 },
      { address = 2, name = "Model Information", type = "uint32", size = 4 },
      { address = 6, name = "Firmware Version", type = "uint8", size = 1 },
      { address = 7, name = "ID", type = "uint8", size = 1 },
      {
        address = 8,
        name = "Baud Rate",
        type = "uint8",
        size = 1,
        values = {
          [0] = "9,600 bps",
          [1] = "57,600 bps",
          [2] = "115,200 bps",
          [3] = "1 Mbps",
          [4] = "2 Mbps",
          [5] = "3 Mbps",
          [6] = "4 Mbps",
          [7] = "4.5 Mbps",
        },
      },
      { address = 9, name = "Return Delay Time", type = "uint8", size = 1, unit = { 2, "µs" } },
      {
        address = 10,
        name = "Drive Mode",
        type = "uint8",
        size = 1,
        bits = {
          {
            name = "Reverse Mode",
            mask = 0x01,
            values = { [0] = "Normal (positive is counterclockwise)", [1] = "Reverse (positive is clockwise)" },
          },
          {
            name = "Profile Configuration",
            mask = 0x04,
            values = { [0] = "Velocity-based profile", [1] = "Time-based profile" },
          },
          {
            name = "Torque On by Goal Update",
            mask = 0x08,
            values = { [0] = "A goal does not turn torque on", [1] = "A goal turns torque on" },
          },
        },
      },
      {
        address = 11,
        name = "Operating Mode",
        type = "uint8",
        size = 1,
        values = {
          [0] = "Current Control Mode",
          [1] = "Velocity Control Mode",
          [3] = "Position Control Mode",
          [4] = "Extended Position Control Mode",
          [5] = "Current-based Position Mode",
          [16] = "PWM Control Mode",
        },
      },
      { address = 12, name = "Secondary(Shadow) ID", type = "uint8", size = 1 },
      {
        address = 13,
        name = "Protocol Type",
        type = "uint8",
        size = 1,
        values = { [1] = "DYNAMIXEL Protocol 1.0", [2] = "DYNAMIXEL Protocol 2.0" },
      },
      { address = 20, name = "Homing Offset", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 24, name = "Moving Threshold", type = "uint32", size = 4, unit = { 0.229, "rev/min" } },
      { address = 31, name = "Temperature Limit", type = "uint8", size = 1, unit = { 1, "°C" } },
      { address = 32, name = "Max Voltage Limit", type = "uint16", size = 2, unit = { 0.1, "V" } },
      { address = 34, name = "Min Voltage Limit", type = "uint16", size = 2, unit = { 0.1, "V" } },
      { address = 36, name = "PWM Limit", type = "uint16", size = 2, unit = { 0.113, "%" } },
      { address = 38, name = "Current Limit", type = "uint16", size = 2, unit = { 2.69, "mA" } },
      { address = 44, name = "Velocity Limit", type = "uint32", size = 4, unit = { 0.229, "rev/min" } },
      { address = 48, name = "Max Position Limit", type = "uint32", size = 4, unit = { 1, "count" } },
      { address = 52, name = "Min Position Limit", type = "uint32", size = 4, unit = { 1, "count" } },
      {
        address = 60,
        name = "Startup Configuration",
        type = "uint8",
        size = 1,
        bits = { { name = "Startup Torque On", mask = 0x01 }, { name = "RAM Restore", mask = 0x02 } },
      },
      {
        address = 63,
        name = "Shutdown",
        type = "uint8",
        size = 1,
        bits = {
          { name = "Input Voltage Error", mask = 0x01 },
          { name = "Overheating Error", mask = 0x04 },
          { name = "Motor Encoder Error", mask = 0x08 },
          { name = "Electrical Shock Error", mask = 0x10 },
          { name = "Overload Error", mask = 0x20 },
        },
      },
      {
        address = 64,
        name = "Torque Enable",
        type = "uint8",
        size = 1,
        values = { [0] = "Torque off", [1] = "Torque on, EEPROM area locked" },
      },
      { address = 65, name = "LED", type = "uint8", size = 1, values = { [0] = "LED off", [1] = "LED on" } },
      {
        address = 68,
        name = "Status Return Level",
        type = "uint8",
        size = 1,
        values = { [0] = "Answers Ping", [1] = "Answers Ping and Read", [2] = "Answers all instructions" },
      },
      {
        address = 69,
        name = "Registered Instruction",
        type = "uint8",
        size = 1,
        values = { [0] = "No instruction registered", [1] = "Instruction registered" },
      },
      {
        address = 70,
        name = "Hardware Error Status",
        type = "uint8",
        size = 1,
        bits = {
          { name = "Input Voltage Error", mask = 0x01 },
          { name = "Overheating Error", mask = 0x04 },
          { name = "Motor Encoder Error", mask = 0x08 },
          { name = "Electrical Shock Error", mask = 0x10 },
          { name = "Overload Error", mask = 0x20 },
        },
      },
      { address = 76, name = "Velocity I Gain", type = "uint16", size = 2 },
      { address = 78, name = "Velocity P Gain", type = "uint16", size = 2 },
      { address = 80, name = "Position D Gain", type = "uint16", size = 2 },
      { address = 82, name = "Position I Gain", type = "uint16", size = 2 },
      { address = 84, name = "Position P Gain", type = "uint16", size = 2 },
      { address = 88, name = "Feedforward 2nd Gain", type = "uint16", size = 2 },
      { address = 90, name = "Feedforward 1st Gain", type = "uint16", size = 2 },
      { address = 98, name = "Bus Watchdog", type = "int8", size = 1, unit = { 20, "ms" } },
      { address = 100, name = "Goal PWM", type = "int16", size = 2, unit = { 0.113, "%" } },
      { address = 102, name = "Goal Current", type = "int16", size = 2, unit = { 2.69, "mA" } },
      { address = 104, name = "Goal Velocity", type = "int32", size = 4, unit = { 0.229, "rev/min" } },
      { address = 108, name = "Profile Acceleration", type = "uint32", size = 4 },
      { address = 112, name = "Profile Velocity", type = "uint32", size = 4 },
      { address = 116, name = "Goal Position", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 120, name = "Realtime Tick", type = "uint16", size = 2, unit = { 1, "ms" } },
      {
        address = 122,
        name = "Moving",
        type = "uint8",
        size = 1,
        values = { [0] = "Movement not detected", [1] = "Movement detected or profile in progress" },
      },
      {
        address = 123,
        name = "Moving Status",
        type = "uint8",
        size = 1,
        bits = {
          { name = "In-Position", mask = 0x01 },
          { name = "Profile Ongoing", mask = 0x02 },
          { name = "Following Error", mask = 0x08 },
          {
            name = "Profile Type",
            mask = 0x30,
            values = {
              [0] = "Profile unused (step)",
              [1] = "Rectangle velocity profile",
              [2] = "Triangle velocity profile",
              [3] = "Trapezoidal velocity profile",
            },
          },
        },
      },
      { address = 124, name = "Present PWM", type = "int16", size = 2, unit = { 0.113, "%" } },
      { address = 126, name = "Present Current", type = "int16", size = 2, unit = { 2.69, "mA" } },
      { address = 128, name = "Present Velocity", type = "int32", size = 4, unit = { 0.229, "rev/min" } },
      { address = 132, name = "Present Position", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 136, name = "Velocity Trajectory", type = "int32", size = 4, unit = { 0.229, "rev/min" } },
      { address = 140, name = "Position Trajectory", type = "int32", size = 4, unit = { 1, "count" } },
      { address = 144, name = "Present Input Voltage", type = "uint16", size = 2, unit = { 0.1, "V" } },
      { address = 146, name = "Present Temperature", type = "uint8", size = 1, unit = { 1, "°C" } },
      {
        address = 147,
        name = "Backup Ready",
        type = "uint8",
        size = 1,
        values = { [0] = "No backup", [1] = "Backup exists" },
      },
      { address = 168, name = "Indirect Address 1", type = "uint16", size = 2 },
      { address = 170, name = "Indirect Address 2", type = "uint16", size = 2 },
      { address = 172, name = "Indirect Address 3", type = "uint16", size = 2 },
      { address = 174, name = "Indirect Address 4", type = "uint16", size = 2 },
      { address = 176, name = "Indirect Address 5", type = "uint16", size = 2 },
      { address = 178, name = "Indirect Address 6", type = "uint16", size = 2 },
      { address = 180, name = "Indirect Address 7", type = "uint16", size = 2 },
      { address = 182, name = "Indirect Address 8", type = "uint16", size = 2 },
      { address = 184, name = "Indirect Address 9", type = "uint16", size = 2 },
      { address = 186, name = "Indirect Address 10", type = "uint16", size = 2 },
      { address = 188, name = "Indirect Address 11", type = "uint16", size = 2 },
      { address = 190, name = "Indirect Address 12", type = "uint16", size = 2 },
      { address = 192, name = "Indirect Address 13", type = "uint16", size = 2 },
      { address = 194, name = "Indirect Address 14", type = "uint16", size = 2 },
      { address = 196, name = "Indirect Address 15", type = "uint16", size = 2 },
      { address = 198, name = "Indirect Address 16", type = "uint16", size = 2 },
      { address = 200, name = "Indirect Address 17", type = "uint16", size = 2 },
      { address = 202, name = "Indirect Address 18", type = "uint16", size = 2 },
      { address = 204, name = "Indirect Address 19", type = "uint16", size = 2 },
      { address = 206, name = "Indirect Address 20", type = "uint16", size = 2 },
      { address = 208, name = "Indirect Address 21", type = "uint16", size = 2 },
      { address = 210, name = "Indirect Address 22", type = "uint16", size = 2 },
      { address = 212, name = "Indirect Address 23", type = "uint16", size = 2 },
      { address = 214, name = "Indirect Address 24", type = "uint16", size = 2 },
      { address = 216, name = "Indirect Address 25", type = "uint16", size = 2 },
      { address = 218, name = "Indirect Address 26", type = "uint16", size = 2 },
      { address = 220, name = "Indirect Address 27", type = "uint16", size = 2 },
      { address = 222, name = "Indirect Address 28", type = "uint16", size = 2 },
      { address = 224, name = "Indirect Data 1", type = "uint8", size = 1 },
      { address = 225, name = "Indirect Data 2", type = "uint8", size = 1 },
      { address = 226, name = "Indirect Data 3", type = "uint8", size = 1 },
      { address = 227, name = "Indirect Data 4", type = "uint8", size = 1 },
      { address = 228, name = "Indirect Data 5", type = "uint8", size = 1 },
      { address = 229, name = "Indirect Data 6", type = "uint8", size = 1 },
      { address = 230, name = "Indirect Data 7", type = "uint8", size = 1 },
      { address = 231, name = "Indirect Data 8", type = "uint8", size = 1 },
      { address = 232, name = "Indirect Data 9", type = "uint8", size = 1 },
      { address = 233, name = "Indirect Data 10", type = "uint8", size = 1 },
      { address = 234, name = "Indirect Data 11", type = "uint8", size = 1 },
      { address = 235, name = "Indirect Data 12", type = "uint8", size = 1 },
      { address = 236, name = "Indirect Data 13", type = "uint8", size = 1 },
      { address = 237, name = "Indirect Data 14", type = "uint8", size = 1 },
      { address = 238, name = "Indirect Data 15", type = "uint8", size = 1 },
      { address = 239, name = "Indirect Data 16", type = "uint8", size = 1 },
      { address = 240, name = "Indirect Data 17", type = "uint8", size = 1 },
      { address = 241, name = "Indirect Data 18", type = "uint8", size = 1 },
      { address = 242, name = "Indirect Data 19", type = "uint8", size = 1 },
      { address = 243, name = "Indirect Data 20", type = "uint8", size = 1 },
      { address = 244, name = "Indirect Data 21", type = "uint8", size = 1 },
      { address = 245, name = "Indirect Data 22", type = "uint8", size = 1 },
      { address = 246, name = "Indirect Data 23", type = "uint8", size = 1 },
      { address = 247, name = "Indirect Data 24", type = "uint8", size = 1 },
      { address = 248, name = "Indirect Data 25", type = "uint8", size = 1 },
      { address = 249, name = "Indirect Data 26", type = "uint8", size = 1 },
      { address = 250, name = "Indirect Data 27", type = "uint8", size = 1 },
      { address = 251, name = "Indirect Data 28", type = "uint8", size = 1 },
      { address = 578, name = "Indirect Address 29", type = "uint16", size = 2 },
      { address = 580, name = "Indirect Address 30", type = "uint16", size = 2 },
      { address = 582, name = "Indirect Address 31", type = "uint16", size = 2 },
      { address = 584, name = "Indirect Address 32", type = "uint16", size = 2 },
      { address = 586, name = "Indirect Address 33", type = "uint16", size = 2 },
      { address = 588, name = "Indirect Address 34", type = "uint16", size = 2 },
      { address = 590, name = "Indirect Address 35", type = "uint16", size = 2 },
      { address = 592, name = "Indirect Address 36", type = "uint16", size = 2 },
      { address = 594, name = "Indirect Address 37", type = "uint16", size = 2 },
      { address = 596, name = "Indirect Address 38", type = "uint16", size = 2 },
      { address = 598, name = "Indirect Address 39", type = "uint16", size = 2 },
      { address = 600, name = "Indirect Address 40", type = "uint16", size = 2 },
      { address = 602, name = "Indirect Address 41", type = "uint16", size = 2 },
      { address = 604, name = "Indirect Address 42", type = "uint16", size = 2 },
      { address = 606, name = "Indirect Address 43", type = "uint16", size = 2 },
      { address = 608, name = "Indirect Address 44", type = "uint16", size = 2 },
      { address = 610, name = "Indirect Address 45", type = "uint16", size = 2 },
      { address = 612, name = "Indirect Address 46", type = "uint16", size = 2 },
      { address = 614, name = "Indirect Address 47", type = "uint16", size = 2 },
      { address = 616, name = "Indirect Address 48", type = "uint16", size = 2 },
      { address = 618, name = "Indirect Address 49", type = "uint16", size = 2 },
      { address = 620, name = "Indirect Address 50", type = "uint16", size = 2 },
      { address = 622, name = "Indirect Address 51", type = "uint16", size = 2 },
      { address = 624, name = "Indirect Address 52", type = "uint16", size = 2 },
      { address = 626, name = "Indirect Address 53", type = "uint16", size = 2 },
      { address = 628, name = "Indirect Address 54", type = "uint16", size = 2 },
      { address = 630, name = "Indirect Address 55", type = "uint16", size = 2 },
      { address = 632, name = "Indirect Address 56", type = "uint16", size = 2 },
      { address = 634, name = "Indirect Data 29", type = "uint8", size = 1 },
      { address = 635, name = "Indirect Data 30", type = "uint8", size = 1 },
      { address = 636, name = "Indirect Data 31", type = "uint8", size = 1 },
      { address = 637, name = "Indirect Data 32", type = "uint8", size = 1 },
      { address = 638, name = "Indirect Data 33", type = "uint8", size = 1 },
      { address = 639, name = "Indirect Data 34", type = "uint8", size = 1 },
      { address = 640, name = "Indirect Data 35", type = "uint8", size = 1 },
      { address = 641, name = "Indirect Data 36", type = "uint8", size = 1 },
      { address = 642, name = "Indirect Data 37", type = "uint8", size = 1 },
      { address = 643, name = "Indirect Data 38", type = "uint8", size = 1 },
      { address = 644, name = "Indirect Data 39", type = "uint8", size = 1 },
      { address = 645, name = "Indirect Data 40", type = "uint8", size = 1 },
      { address = 646, name = "Indirect Data 41", type = "uint8", size = 1 },
      { address = 647, name = "Indirect Data 42", type = "uint8", size = 1 },
      { address = 648, name = "Indirect Data 43", type = "uint8", size = 1 },
      { address = 649, name = "Indirect Data 44", type = "uint8", size = 1 },
      { address = 650, name = "Indirect Data 45", type = "uint8", size = 1 },
      { address = 651, name = "Indirect Data 46", type = "uint8", size = 1 },
      { address = 652, name = "Indirect Data 47", type = "uint8", size = 1 },
      { address = 653, name = "Indirect Data 48", type = "uint8", size = 1 },
      { address = 654, name = "Indirect Data 49", type = "uint8", size = 1 },
      { address = 655, name = "Indirect Data 50", type = "uint8", size = 1 },
      { address = 656, name = "Indirect Data 51", type = "uint8", size = 1 },
      { address = 657, name = "Indirect Data 52", type = "uint8", size = 1 },
      { address = 658, name = "Indirect Data 53", type = "uint8", size = 1 },
      { address = 659, name = "Indirect Data 54", type = "uint8", size = 1 },
      { address = 660, name = "Indirect Data 55", type = "uint8", size = 1 },
      { address = 661, name = "Indirect Data 56", type = "uint8", size = 1 },
    },
  },
}

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

end

-- The INNFOS Ethernet protocol --------------------------------------------------------------

do
-- Found in datagrams to and from the port of the control board, below; for another port use
-- Decode As.

local TITLE = "INNFOS Ethernet protocol"
local HEADER = "\xEE"
local TAIL = 0xED
local BROADCAST = 0
local UDP = { port = 2000, address = "192.168.1.30" }
local CRC = {
  name = "CRC-16/MODBUS",
  polynomial = 0x8005,
  initial = 0xFFFF,
  reflected = true,
  final_xor = 0x0000,
  check = 0x4B37,
}
local CRC_FROM = { request = 1, reply = 2 }
local CRC_MAY = { [0x02] = true, [0x44] = true }
local FLAGS = { [0] = "no (failure, disabled, off)", [1] = "yes (success, enabled, on, normal)" }
local FRACTION_BITS = { iq8 = 8, iq24 = 24 }
local COMMANDS = {
  [0x44] = { name = "Board handshake", operation = "read", request = 0, reply = { 1 }, format = "flag" },
  [0x02] = { name = "Actuator query", operation = "read", request = 0, reply = { 4, 6 }, format = "mac" },
  [0x00] = { name = "Handshake", operation = "read", request = 0, reply = { 1 }, format = "flag" },
  [0x55] = { name = "Mode", operation = "read", request = 0, reply = { 1 }, format = "mode" },
  [0xB0] = { name = "Last shutdown state", operation = "read", request = 0, reply = { 1 }, format = "flag" },
  [0x71] = { name = "Current loop filter state", operation = "read", request = 0, reply = { 1 }, format = "flag" },
  [0x75] = { name = "Speed loop filter state", operation = "read", request = 0, reply = { 1 }, format = "flag" },
  [0x79] = { name = "Position loop filter state", operation = "read", request = 0, reply = { 1 }, format = "flag" },
  [0x2B] = { name = "Power state", operation = "read", request = 0, reply = { 1 }, format = "flag" },
  [0x73] = {
    name = "Current loop filter bandwidth",
    operation = "read",
    request = 0,
    reply = { 2 },
    format = "iq8",
    unit = "Hz",
  },
  [0x77] = {
    name = "Speed loop filter bandwidth",
    operation = "read",
    request = 0,
    reply = { 2 },
    format = "iq8",
    unit = "Hz",
  },
  [0x7B] = {
    name = "Position loop filter bandwidth",
    operation = "read",
    request = 0,
    reply = { 2 },
    format = "iq8",
    unit = "Hz",
  },
  [0x5F] = {
    name = "Actuator temperature",
    operation = "read",
    request = 0,
    reply = { 2 },
    format = "iq8",
    unit = "°C",
  },
  [0x60] = {
    name = "Inverter temperature",
    operation = "read",
    request = 0,
    reply = { 2 },
    format = "iq8",
    unit = "°C",
  },
  [0x62] = {
    name = "Inverter protection temperature",
    operation = "read",
    request = 0,
    reply = { 2 },
    format = "iq8",
    unit = "°C",
  },
  [0x64] = {
    name = "Inverter recovery temperature",
    operation = "read",
    request = 0,
    reply = { 2 },
    format = "iq8",
    unit = "°C",
  },
  [0xFF] = { name = "Alarms", operation = "read", request = 0, reply = { 2 }, format = "alarms" },
  [0x04] = {
    name = "Current",
    operation = "read",
    request = 0,
    reply = { 4 },
    format = "iq24",
    unit = "A",
    full_scale = "current",
  },
  [0x05] = {
    name = "Speed",
    operation = "read",
    request = 0,
    reply = { 4 },
    format = "iq24",
    unit = "RPM",
    full_scale = "motor speed",
  },
  [0x06] = { name = "Position", operation = "read", request = 0, reply = { 4 }, format = "iq24", unit = "R" },
  [0x15] = { name = "Current loop P", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x16] = { name = "Current loop I", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x17] = { name = "Speed loop P", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x18] = { name = "Speed loop I", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x19] = { name = "Position loop P", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x1A] = { name = "Position loop I", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x1C] = { name = "Position profile maximum speed", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x1D] = { name = "Position profile acceleration", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x1E] = { name = "Position profile deceleration", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x22] = { name = "Speed profile maximum speed", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x23] = { name = "Speed profile acceleration", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x24] = { name = "Speed profile deceleration", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x34] = {
    name = "Current loop output lower limit",
    operation = "read",
    request = 0,
    reply = { 4 },
    format = "iq24",
  },
  [0x35] = {
    name = "Current loop output upper limit",
    operation = "read",
    request = 0,
    reply = { 4 },
    format = "iq24",
  },
  [0x36] = { name = "Speed loop output lower limit", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x37] = { name = "Speed loop output upper limit", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x38] = {
    name = "Position loop output lower limit",
    operation = "read",
    request = 0,
    reply = { 4 },
    format = "iq24",
    unit = "RPM",
    full_scale = "motor speed",
  },
  [0x39] = {
    name = "Position loop output upper limit",
    operation = "read",
    request = 0,
    reply = { 4 },
    format = "iq24",
    unit = "RPM",
    full_scale = "motor speed",
  },
  [0x7D] = { name = "Inertia", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x85] = { name = "Position upper limit", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x86] = { name = "Position lower limit", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x8A] = { name = "Position offset", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x92] = { name = "Homing current lower limit", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x93] = { name = "Homing current upper limit", operation = "read", request = 0, reply = { 4 }, format = "iq24" },
  [0x7F] = {
    name = "Stall energy",
    operation = "read",
    request = 0,
    reply = { 4 },
    format = "scaled",
    factor = 75.225,
    unit = "J",
  },
  [0x07] = { name = "Mode", operation = "write", request = 1, reply = { 1 }, format = "mode" },
  [0x70] = { name = "Current loop filter state", operation = "write", request = 1, reply = { 1 }, format = "flag" },
  [0x74] = { name = "Speed loop filter state", operation = "write", request = 1, reply = { 1 }, format = "flag" },
  [0x78] = { name = "Position loop filter state", operation = "write", request = 1, reply = { 1 }, format = "flag" },
  [0x2A] = { name = "Power state", operation = "write", request = 1, reply = { 1 }, format = "flag" },
  [0x72] = {
    name = "Current loop filter bandwidth",
    operation = "write",
    request = 2,
    reply = { 1 },
    format = "iq8",
    unit = "Hz",
  },
  [0x76] = {
    name = "Speed loop filter bandwidth",
    operation = "write",
    request = 2,
    reply = { 1 },
    format = "iq8",
    unit = "Hz",
  },
  [0x7A] = {
    name = "Position loop filter bandwidth",
    operation = "write",
    request = 2,
    reply = { 1 },
    format = "iq8",
    unit = "Hz",
  },
  [0x61] = {
    name = "Inverter protection temperature",
    operation = "write",
    request = 2,
    reply = { 1 },
    format = "iq8",
    unit = "°C",
  },
  [0x63] = {
    name = "Inverter recovery temperature",
    operation = "write",
    request = 2,
    reply = { 1 },
    format = "iq8",
    unit = "°C",
  },
  [0x08] = {
    name = "Current",
    operation = "write",
    request = 4,
    reply = {},
    format = "iq24",
    unit = "A",
    full_scale = "current",
  },
  [0x09] = {
    name = "Speed",
    operation = "write",
    request = 4,
    reply = {},
    format = "iq24",
    unit = "RPM",
    full_scale = "motor speed",
  },
  [0x0A] = { name = "Position", operation = "write", request = 4, reply = {}, format = "iq24", unit = "R" },
  [0x0E] = { name = "Current loop P", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x0F] = { name = "Current loop I", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x10] = { name = "Speed loop P", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x11] = { name = "Speed loop I", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x12] = { name = "Position loop P", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x13] = { name = "Position loop I", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x1F] = {
    name = "Position profile maximum speed",
    operation = "write",
    request = 4,
    reply = { 1 },
    format = "iq24",
  },
  [0x20] = { name = "Position profile acceleration", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x21] = { name = "Position profile deceleration", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x25] = { name = "Speed profile maximum speed", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x26] = { name = "Speed profile acceleration", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x27] = { name = "Speed profile deceleration", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x2E] = {
    name = "Current loop output lower limit",
    operation = "write",
    request = 4,
    reply = { 1 },
    format = "iq24",
  },
  [0x2F] = {
    name = "Current loop output upper limit",
    operation = "write",
    request = 4,
    reply = { 1 },
    format = "iq24",
  },
  [0x30] = { name = "Speed loop output lower limit", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x31] = { name = "Speed loop output upper limit", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x32] = {
    name = "Position loop output lower limit",
    operation = "write",
    request = 4,
    reply = { 1 },
    format = "iq24",
    unit = "RPM",
    full_scale = "motor speed",
  },
  [0x33] = {
    name = "Position loop output upper limit",
    operation = "write",
    request = 4,
    reply = { 1 },
    format = "iq24",
    unit = "RPM",
    full_scale = "motor speed",
  },
  [0x83] = { name = "Position upper limit", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x84] = { name = "Position lower limit", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x87] = { name = "Home value", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x89] = { name = "Position offset", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x90] = { name = "Homing current lower limit", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x91] = { name = "Homing current upper limit", operation = "write", request = 4, reply = { 1 }, format = "iq24" },
  [0x7E] = {
    name = "Stall energy",
    operation = "write",
    request = 4,
    reply = { 1 },
    format = "scaled",
    factor = 75.225,
    unit = "J",
  },
  [0xFE] = { name = "Clear alarms", operation = "write", request = 0, reply = { 1 } },
  [0x88] = { name = "Clear homing data", operation = "write", request = 0, reply = { 1 } },
  [0x0D] = { name = "Save parameters", operation = "write", request = 0, reply = { 1 } },
}
local MODES = {
  [1] = "Current",
  [2] = "Speed",
  [3] = "Position",
  [4] = "Teaching",
  [5] = "Playback",
  [6] = "Trapezoidal position",
  [7] = "Trapezoidal speed",
  [8] = "Homing",
}
local ALARMS = {
  { mask = 0x01, name = "Overvoltage" },
  { mask = 0x02, name = "Undervoltage" },
  { mask = 0x04, name = "Locked rotor" },
  { mask = 0x08, name = "Overheating" },
  { mask = 0x10, name = "Reading parameters" },
  { mask = 0x20, name = "Counting turns" },
  { mask = 0x40, name = "Inverter temperature sensor" },
  { mask = 0x80, name = "CAN communication" },
  { mask = 0x100, name = "Motor temperature sensor" },
  { mask = 0x200, name = "Step of more than 1 in position mode" },
  { mask = 0x400, name = "Driver protection" },
}
local OTHER_ALARM = "Equipment error"

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

end
