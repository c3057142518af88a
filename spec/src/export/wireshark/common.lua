
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
