use eigenring::{analysis::Analyzer, scheme::catalogue};
fn main(){
  for l in catalogue::SCHEMES { let s=catalogue::open(l.id).unwrap().unwrap(); 
   s.check(&[3,4,5]).unwrap(); eigenring::refine::check_symmetry(&s,&[3,4,5,7]).unwrap_or_else(|f| println!("{f}"));
   let a=Analyzer::new(&s).unwrap();
   for n in 3..=8 { let r=a.at(n).unwrap();
     let sd=r.spectrum.subdominant().unwrap(); let ss=r.spectrum.after_subdominant().next().unwrap();
     println!("{} {n} size {} lam {:.13} f{} mu {:.10} f{} ratio {:.6} cup {:?} saddle {:?} shape {:?} res {:?}", l.id, r.local.size(), sd.value.re, sd.frequency, ss.value.norm(), ss.frequency, ss.value.norm()/sd.value.re.powi(2), r.classical.cup.map(|e|e.value.re), r.classical.saddle.map(|e|e.value.re), r.map.as_ref().and_then(|m|m.shape), r.spectrum.approx_residual(&r.blocks,&r.cores));
     if n==5 { println!("orbits {:?} cores {:?} limit {:?}", r.local.orbits, r.cores.cores, r.limit_mask.as_ref().map(|m|(m.centre,m.amplitudes.clone()))); println!("tangent {:?} net {:?}", r.tangent_masks.as_ref().map(|t|t[0].amplitudes.clone()), r.map.as_ref().map(|m|m.net.clone())); }
   }
   let t=std::time::Instant::now(); for n in 3..=12 { a.at(n).unwrap(); } println!("{:?}", t.elapsed());
  }
}
