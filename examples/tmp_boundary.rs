use eigenring::analysis::boundary::halves::Parity;
use eigenring::analysis::boundary::*;
use eigenring::mesh::FanKind;
use eigenring::scheme::catalogue;
fn main() {
    for id in ["loop", "catmull-clark"] {
        let scheme = catalogue::open(id).unwrap().unwrap();
        let book = catalogue::boundary("cubic", &scheme.mesh).unwrap().unwrap();
        let t = std::time::Instant::now();
        let a = BoundaryAnalyzer::new(&scheme, &book).unwrap();
        println!("{id} new {:?}", t.elapsed());
        let mut kinds: Vec<FanKind> = (1..9).map(|faces| FanKind::Crease { faces }).collect();
        kinds.extend((1..5).map(|faces| FanKind::Corner { faces }));
        kinds.extend((3..9).map(|faces| FanKind::Dart { faces }));
        kinds.extend([64, 200].map(|faces| FanKind::Crease { faces }));
        for kind in kinds {
            let t = std::time::Instant::now();
            let b = a.at(kind).unwrap();
            let time = t.elapsed();
            let es: Vec<String> = b
                .spectrum
                .distinct()
                .iter()
                .take(7)
                .map(|e| format!("{:.6}{}x{}", e.value, &Parity::of_part(e.frequency).name()[..1], e.cluster))
                .collect();
            println!("{kind:?} size {} {:?} | {}", b.local.size(), time, es.join(" "));
            if kind.faces() < 20 {
                let m = |m: &Vec<(eigenring::mesh::Label, f64)>| {
                    m.iter()
                        .map(|(l, w)| format!("{}:{},{}={:.5}", l.sector, l.i, l.j, w))
                        .collect::<Vec<_>>()
                        .join(" ")
                };
                println!("   limit {:?}", b.limit_mask.as_ref().map(m));
                match &b.tangent_masks {
                    Ok(t) => println!("   t0 {}\n   t1 {}", m(&t.masks[0]), m(&t.masks[1])),
                    Err(e) => println!("   {e}"),
                }
            }
        }
    }
}
