//! What packets mean, and which are in the document's tables.

use actucheck_spec::model::Outcome;
use actucheck_spec::wire::innfos::Packet;
use actucheck_spec::wire::innfos::reference::{is_in_tables, meaning, packet as back};
use actucheck_spec::wire::{self, Direction, Value};

use super::{spec, vectors};

fn read(direction: Direction, command: u8, data: &[u8]) -> Option<Value> {
    let spec = spec();
    let innfos = &spec.wires.innfos.content;
    let packet = Packet { direction, address: 6, command, data: data.to_vec().into() };
    let actuator = innfos.actuators.rows.iter().find(|row| row.name == "DD-6010");
    meaning(innfos, &packet, actuator)?.message.value
}

fn number(value: f64) -> Value {
    Value::Number(value.try_into().expect("a finite number"))
}

#[test]
fn the_documents_numbers_mean_what_it_says() {
    use Direction::{Reply, Request};
    // §IQmath Introduction: -2.0, and the position of 60 revolutions.
    assert_eq!(read(Request, 0x0A, &[0xFE, 0, 0, 0]), Some(number(-2.0)));
    assert_eq!(read(Request, 0x0A, &[0x3C, 0, 0, 0]), Some(number(60.0)));
    // §A.1.3: 75.225 times the energy in J.
    assert_eq!(read(Request, 0x7E, &[0, 0, 0x0B, 0xC1]), Some(number(3009.0 / 75.225)));
    assert_eq!(read(Reply, 0x5F, &[0xF5, 0xC0]), Some(number(-10.25)));
    // Half of 33 A.
    assert_eq!(read(Reply, 0x04, &[0, 0x80, 0, 0]), Some(number(16.5)));
    // §Appendix B and §Appendix C.
    let name = |name: &str| Some(Value::Name(name.to_owned()));
    assert_eq!(read(Request, 0x07, &[6]), name("Trapezoidal position"));
    assert_eq!(read(Reply, 0x07, &[1]), name("yes"));
    let flags = ["Overvoltage", "Locked rotor", "Equipment error"].map(str::to_owned);
    assert_eq!(read(Reply, 0xFF, &[0x08, 0x05]), Some(Value::Flags(flags.into())));
    assert_eq!(read(Request, 0x07, &[9]), None);
}

#[test]
fn a_meaning_leads_back_to_its_packet() {
    let spec = spec();
    let innfos = &spec.wires.innfos.content;
    let actuator = innfos.actuators.rows.first();
    let mut asked = 0;
    for row in &innfos.commands {
        for direction in Direction::ALL {
            let Some(size) = row.size_in(direction) else { continue };
            for byte in [0x00, 0x01, 0x80, 0xFF] {
                let data = vec![byte; usize::from(size)].into();
                let packet = Packet { direction, address: 6, command: row.code, data };
                let Some(meaning) = meaning(innfos, &packet, actuator) else { continue };
                let named = meaning.message.value.clone();
                if let Some(Value::Flags(flags)) = named
                    && flags.contains(&innfos.alarms.other)
                {
                    continue;
                }
                assert!(is_in_tables(innfos, &packet) || row.code == 0x44 || row.code == 0x02);
                assert_eq!(back(innfos, &meaning.message, actuator), Some(packet));
                asked += 1;
            }
        }
    }
    assert!(asked > 300, "{asked}");
}

#[test]
fn what_the_vectors_demand_is_in_the_tables() {
    let spec = spec();
    let innfos = &spec.wires.innfos.content;
    let mut demanded = 0;
    for vector in vectors(&spec) {
        let Some(wire::Packet::Innfos(packet)) = &vector.packet else { continue };
        if vector.result != Outcome::Acceptable {
            assert!(is_in_tables(innfos, packet), "{}", vector.id);
            demanded += 1;
        }
    }
    assert!(demanded > 20, "{demanded}");
}

#[test]
fn sizes_forms_and_addresses_matter() {
    let spec = spec();
    let has = |direction, address, command, data: &[u8]| {
        let packet = Packet { direction, address, command, data: data.to_vec().into() };
        is_in_tables(&spec.wires.innfos.content, &packet)
    };
    let (request, reply) = (Direction::Request, Direction::Reply);
    assert!(has(request, 0, 0x2A, &[0]) && !has(request, 6, 0x2A, &[2]));
    assert!(has(request, 6, 0x07, &[8]) && !has(request, 6, 0x07, &[9]));
    assert!(has(request, 6, 0x06, &[]) && !has(request, 6, 0x06, &[1, 2]));
    assert!(has(reply, 6, 0x06, &[1, 2, 3, 4]) && !has(reply, 0, 0x06, &[1, 2, 3, 4]));
    assert!(has(request, 6, 0x0A, &[1, 2, 3, 4]) && !has(reply, 6, 0x0A, &[1]));
    assert!(has(request, 0, 0x44, &[]) && !has(request, 6, 0x44, &[]));
    assert!(!has(reply, 0, 0x44, &[1]) && !has(request, 6, 0x01, &[]));
    assert!(has(reply, 6, 0x02, &[1, 2, 3, 4]) && !has(reply, 6, 0x02, &[1, 2, 3, 4, 5, 6]));
}
