//! Functions as tapes, as `ukcore::scalar::Tape` describes them: numbers that are seldom computed with read them.

use super::body::{ascending, float, known_first};
use super::names::Slots;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};
use ukalgebra::analysis::{Function, Place, Role, Step};
use ukalgebra::expr::{Func, Graph, Id, Map, Node, Symbol, System};

/// The statement that reads `function` off a tape, in numbers that want it so. None where the runtime does not call it with such numbers,
/// or where it takes more registers than a tape can name.
pub(super) fn tape(
    system: &System,
    function: &Function,
    slots: Slots<'_>,
    (coordinates, parameters): (usize, usize),
) -> Option<TokenStream> {
    use Role::{Acceleration, Dynamics, Prepare, Residual, ResidualRate, Switching};
    let role = function.role;
    let taped = [
        Prepare,
        Dynamics,
        Residual,
        ResidualRate,
        Acceleration,
        Switching,
    ];
    if function.roots.is_empty() || !taped.contains(&role) {
        return None;
    }
    let inputs: &[(&str, usize)] = &[
        ("t", 1),
        ("q", coordinates),
        ("v", coordinates),
        ("prepared", slots.symbols().count()),
    ];
    let inputs = match role {
        Prepare => vec![("given", parameters)],
        Residual => [&inputs[..2], &inputs[3..]].concat(),
        _ => inputs.to_vec(),
    };
    let mut recorder = Recorder {
        graph: &system.graph,
        inputs: &inputs,
        prepared: slots.values.len(),
        places: Map::default(),
        reciprocals: Map::default(),
        constants: Vec::new(),
        functions: [Vec::new(), Vec::new()],
        instructions: Vec::new(),
        values: 0,
    };
    recorder.record(function);
    let (registers, code) = recorder.encoded()?;
    let (registers, code) = (
        Literal::usize_unsuffixed(registers),
        Literal::byte_string(&code),
    );
    let constants = recorder.constants.iter().map(|x| float(*x));
    let [unary, binary] = recorder.functions.map(|functions| {
        let names = functions.into_iter().map(|func| func.row().name);
        let names = names.map(|name| format_ident!("{name}"));
        quote! { &[#(S::#names),*] }
    });
    let inputs = inputs.iter().map(|(text, len)| {
        let (name, len) = (format_ident!("{text}"), Literal::usize_unsuffixed(*len));
        match *text {
            "t" => quote! { &[t] },
            text => quote! { ukcore::emitted::exact::<S, #len>(#name, #text) },
        }
    });
    let slices = function
        .slices
        .iter()
        .map(|(slice, _)| format_ident!("{}", slice.name()));
    let play = quote! {
        S::play(&TAPE, &mut registers, &[#(#inputs),*], (#unary, #binary), &mut [#(&mut #slices[..]),*])
    };
    let play = match role {
        Acceleration => quote! { return #play; },
        _ => quote! { #play; return; },
    };
    Some(quote! {
        if const { S::TAPED } {
            const TAPE: ukcore::Tape = ukcore::Tape { constants: &[#(#constants),*], code: #code };
            let mut registers = [S::from_f64(0.0); #registers];
            #play
        }
    })
}

/// The place where an operand stands.
#[derive(Clone, Copy)]
enum Operand {
    Input(usize),
    Constant(usize),
    /// A value, by the order in which they are computed.
    Value(usize),
}

/// A part of an instruction.
enum Word {
    To(usize),
    From(Operand),
    Plain(usize),
}

struct Recorder<'a> {
    graph: &'a Graph,
    /// Names and lengths of what is given.
    inputs: &'a [(&'static str, usize)],
    /// How many values depend on parameters only; branches follow them.
    prepared: usize,
    places: Map<Id, Operand>,
    reciprocals: Map<Id, Operand>,
    constants: Vec<f64>,
    /// Functions of one and of two arguments.
    functions: [Vec<Func>; 2],
    instructions: Vec<(u8, Vec<Word>)>,
    values: usize,
}

impl Recorder<'_> {
    /// The steps of `function`, as the emitted statements have them; it does not leave early.
    fn record(&mut self, function: &Function) {
        for step in &function.program.steps {
            match *step {
                Step::Let(id) => {
                    self.place(id);
                }
                Step::Reciprocal(id) => {
                    let base = self.place(id);
                    let reciprocal = self.compute(b'i', &[base]);
                    self.reciprocals.insert(id, reciprocal);
                }
                Step::SinCos { sin, cos } => {
                    let argument = self.place(self.graph.operands(sin)[0]);
                    let [first, second] = [self.values, self.values + 1];
                    self.values += 2;
                    let words = vec![Word::To(first), Word::To(second), Word::From(argument)];
                    self.instructions.push((b's', words));
                    self.places.insert(sin, Operand::Value(first));
                    self.places.insert(cos, Operand::Value(second));
                }
                Step::Store(k) => {
                    let (place, id) = function.roots[k];
                    let value = Word::From(self.place(id));
                    let instruction = match place {
                        Place::Element(slice, at) => {
                            let slice = function.slices.iter().position(|(s, _)| *s == slice);
                            let slice = Word::Plain(slice.unwrap_or_default());
                            let [low, high] = halves(at).map(Word::Plain);
                            (b'=', vec![slice, low, high, value])
                        }
                        _ => (b'.', vec![value]),
                    };
                    self.instructions.push(instruction);
                }
            }
        }
    }

    /// The place where the value of `id` stands, computed here if it was not before.
    fn place(&mut self, id: Id) -> Operand {
        if let Some(place) = self.places.get(&id) {
            return *place;
        }
        let graph = self.graph;
        let place = match graph.node(id) {
            Node::Const(x) => self.constant(x.get()),
            Node::Symbol(symbol) => self.input(*symbol),
            Node::Sum(c, terms) => self.sum(c.get(), terms.iter().map(|(k, t)| (k.get(), *t))),
            Node::Scale(c, inner) => match (c.get(), graph.node(*inner)) {
                // −(a − b) is b − a.
                (-1.0, Node::Sum(c, terms)) if !self.places.contains_key(inner) => {
                    self.sum(-c.get(), terms.iter().map(|(k, t)| (-k.get(), *t)))
                }
                (-1.0, _) => {
                    let inner = self.place(*inner);
                    self.compute(b'n', &[inner])
                }
                (c, _) => {
                    let factors = [self.constant(c), self.place(*inner)];
                    self.compute(b'*', &factors)
                }
            },
            Node::Product(factors) => self.product(factors),
            Node::Held(inner) => self.place(*inner),
            Node::Call(func, args) => {
                let args: Vec<Operand> = args.iter().map(|a| self.place(*a)).collect();
                self.call(*func, &args)
            }
            Node::Select(args) => {
                let args = args.map(|a| self.place(a));
                self.compute(b'?', &args)
            }
        };
        self.places.insert(id, place);
        place
    }

    fn compute(&mut self, sign: u8, operands: &[Operand]) -> Operand {
        self.instruction(sign, &[], operands, &[])
    }

    fn instruction(
        &mut self,
        sign: u8,
        before: &[usize],
        operands: &[Operand],
        behind: &[usize],
    ) -> Operand {
        let plain = |k: &usize| Word::Plain(*k);
        let mut words = vec![Word::To(self.values)];
        words.extend(before.iter().map(plain));
        words.extend(operands.iter().map(|operand| Word::From(*operand)));
        words.extend(behind.iter().map(plain));
        self.instructions.push((sign, words));
        self.values += 1;
        Operand::Value(self.values - 1)
    }

    fn constant(&mut self, x: f64) -> Operand {
        let same = |c: &f64| c.to_bits() == x.to_bits();
        let known = self.constants.iter().position(same);
        Operand::Constant(known.unwrap_or_else(|| {
            self.constants.push(x);
            self.constants.len() - 1
        }))
    }

    fn input(&self, symbol: Symbol) -> Operand {
        let (name, at) = match symbol {
            Symbol::Time => ("t", 0),
            Symbol::Coord(i) => ("q", i),
            Symbol::Velocity(i) => ("v", i),
            Symbol::Param(i) => ("given", i),
            Symbol::Prepared(i) => ("prepared", i),
            Symbol::Branch(i) => ("prepared", self.prepared + i),
            // Only corrections and unsolved reactions have them, and neither is on a tape.
            Symbol::Residual(i) | Symbol::Multiplier(i) => ("residual", i),
        };
        let before = self.inputs.iter().take_while(|(input, _)| *input != name);
        Operand::Input(before.map(|(_, len)| len).sum::<usize>() + at)
    }

    fn call(&mut self, func: Func, args: &[Operand]) -> Operand {
        let functions = &mut self.functions[func.arity() - 1];
        let known = functions.iter().position(|f| *f == func);
        let k = known.unwrap_or_else(|| {
            functions.push(func);
            functions.len() - 1
        });
        let sign = if args.len() == 1 { b'f' } else { b'g' };
        self.instruction(sign, &[k], args, &[])
    }

    /// constant + Σ coefficient · term, in the order of the emitted statements.
    fn sum(&mut self, c: f64, terms: impl Iterator<Item = (f64, Id)>) -> Operand {
        let (leading, terms) = ascending(self.graph, c, terms.collect());
        let mut sum = leading.then(|| self.constant(c));
        for (k, term) in terms {
            let mut factors = Vec::new();
            if k.abs() != 1.0 {
                factors.push(self.constant(k.abs()));
            }
            match self.graph.node(term) {
                Node::Product(product) if !self.places.contains_key(&term) => {
                    let (above, below) = self.sides(product);
                    match below.is_empty() {
                        true => factors.extend(above),
                        false => factors.push(self.quotient(&above, &below)),
                    }
                }
                _ => factors.push(self.place(term)),
            }
            let Some(sum_before) = sum else {
                let product = self.chain(&factors);
                sum = Some(if k < 0.0 {
                    self.compute(b'n', &[product])
                } else {
                    product
                });
                continue;
            };
            let signs = if k < 0.0 { [b'-', b'w'] } else { [b'+', b'm'] };
            sum = Some(match factors.as_slice() {
                // The last factor is known last.
                [factors @ .., last] if !factors.is_empty() => {
                    let factor = self.chain(factors);
                    self.compute(signs[1], &[factor, *last, sum_before])
                }
                factors => {
                    let term = self.chain(factors);
                    self.compute(signs[0], &[sum_before, term])
                }
            });
        }
        let Some(sum) = sum else {
            return self.constant(c);
        };
        let sign = if c > 0.0 { b'+' } else { b'-' };
        match leading || c == 0.0 {
            true => sum,
            false => {
                let size = self.constant(c.abs());
                self.compute(sign, &[sum, size])
            }
        }
    }

    fn product(&mut self, factors: &[(Id, i32)]) -> Operand {
        let (above, below) = self.sides(factors);
        self.quotient(&above, &below)
    }

    /// Factors above and below the fraction bar; what is known first is multiplied first.
    fn sides(&mut self, factors: &[(Id, i32)]) -> (Vec<Operand>, Vec<Operand>) {
        let (mut above, mut below) = (Vec::new(), Vec::new());
        for (base, exponent) in known_first(self.graph, factors) {
            if exponent == -1
                && let Some(reciprocal) = self.reciprocals.get(&base)
            {
                above.push(*reciprocal);
                continue;
            }
            let side = if exponent > 0 { &mut above } else { &mut below };
            let place = self.place(base);
            let n = exponent.unsigned_abs() as usize;
            match n {
                1..=3 => side.extend(std::iter::repeat_n(place, n)),
                _ => {
                    side.push(self.instruction(b'p', &[], &[place], &halves(n)));
                }
            }
        }
        (above, below)
    }

    fn quotient(&mut self, above: &[Operand], below: &[Operand]) -> Operand {
        match (above, below) {
            (above, []) => self.chain(above),
            ([], below) => {
                let below = self.chain(below);
                self.compute(b'i', &[below])
            }
            (above, below) => {
                let sides = [self.chain(above), self.chain(below)];
                self.compute(b'/', &sides)
            }
        }
    }

    /// The product of `factors`, one after the other.
    fn chain(&mut self, factors: &[Operand]) -> Operand {
        let mut factors = factors.iter().copied();
        let first = factors.next().unwrap_or_else(|| self.constant(1.0));
        factors.fold(first, |product, factor| {
            self.compute(b'*', &[product, factor])
        })
    }

    /// How many registers there are, and the instructions on them: a value takes the register that was set free last.
    fn encoded(&self) -> Option<(usize, Vec<u8>)> {
        let inputs: usize = self.inputs.iter().map(|(_, len)| len).sum();
        let fixed = inputs + self.constants.len();
        let mut last = vec![0; self.values];
        for (at, (_, words)) in self.instructions.iter().enumerate() {
            for word in words {
                if let Word::To(value) | Word::From(Operand::Value(value)) = word {
                    last[*value] = at;
                }
            }
        }
        let (mut registers, mut free) = (fixed, Vec::new());
        let mut held = vec![0; self.values];
        let mut code = Vec::new();
        for (at, (sign, words)) in self.instructions.iter().enumerate() {
            let values = |to: bool| {
                words.iter().filter_map(move |word| match word {
                    Word::To(value) if to => Some(*value),
                    Word::From(Operand::Value(value)) if !to => Some(*value),
                    _ => None,
                })
            };
            // Operands are read before results are written.
            let over = values(false).filter(|value| last[*value] == at);
            let mut ended: Vec<usize> = over.map(|value| held[value]).collect();
            ended.sort_unstable();
            ended.dedup();
            free.extend(ended);
            for value in values(true) {
                held[value] = free.pop().unwrap_or_else(|| {
                    registers += 1;
                    registers - 1
                });
            }
            code.extend([*sign, 0]);
            for word in words {
                let word = match *word {
                    Word::Plain(k) => k,
                    Word::From(Operand::Input(k)) => k,
                    Word::From(Operand::Constant(k)) => inputs + k,
                    Word::To(value) | Word::From(Operand::Value(value)) => held[value],
                };
                code.extend(u16::try_from(word).ok()?.to_le_bytes());
            }
            free.extend(
                values(true)
                    .filter(|value| last[*value] == at)
                    .map(|value| held[value]),
            );
        }
        Some((registers, code))
    }
}

/// The two words of a number.
fn halves(n: usize) -> [usize; 2] {
    [n & 0xFFFF, n >> 16]
}
