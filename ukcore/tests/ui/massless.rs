ukcore::multibody! {
    pub Cart {
        params { m = 1.0, k = 1.0 }
        coords { x, y }
        mass { x: m }
        force { x: -k * x, y: -k * y }
    }
}

fn main() {
    let _ = Cart::default();
}
