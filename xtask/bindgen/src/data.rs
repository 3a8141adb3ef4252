//! Which of a module's data only the rest's functions speak of: texts of messages and hints, for the most part. Told
//! from the relocations that the linker leaves with `--emit-relocs`, before bindgen, which drops them.
//!
//! Every address in code or data has a relocation, which names a symbol; a symbol is a range of the data. What the
//! first part's functions name, and what the data there name in turn, stays; bytes of no symbol stay, too.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use wasmparser::{
    DataKind, DefinedDataSymbol, KnownCustom, Linking, LinkingSectionReader, Name,
    NameSectionReader, Operator, Parser, Payload, RelocationType, Result, SymbolInfo, TypeRef,
};

/// A range of the module's memory.
type Addresses = Range<u32>;

/// Gives the ranges of a linked module's data that only functions of the rest reach, in order; none where the linker
/// left no relocations. The rest's functions are told by the linker's names.
///
/// # Errors
/// Bytes that are no module.
pub(crate) fn late(
    linked: &[u8],
    rest: &BTreeSet<&str>,
) -> std::result::Result<Vec<Addresses>, String> {
    Linked::read(linked).map(|linked| linked.late(rest)).map_err(|error| error.to_string())
}

/// An address that stands somewhere: where, and the symbol that it is of.
struct Reference {
    at: usize,
    symbol: u32,
}

/// What of a linked module tells who reaches which data.
#[derive(Default)]
struct Linked<'a> {
    imported: u32,
    /// The linker's names of functions by their index, imported ones included.
    names: BTreeMap<u32, &'a str>,
    /// Where in the file the functions' bodies stand, in order.
    bodies: Vec<Range<usize>>,
    /// The data, each with where it stands in the file and at what address it begins.
    segments: Vec<(Range<usize>, u32)>,
    /// The symbols by their numbers; those that are no data have none.
    symbols: Vec<Option<Addresses>>,
    of_code: Vec<Reference>,
    of_data: Vec<Reference>,
}

impl<'a> Linked<'a> {
    fn read(bytes: &'a [u8]) -> Result<Linked<'a>> {
        let mut read = Linked::default();
        let mut symbols = Vec::new();
        let mut relocations = Vec::new();
        // where the contents of each section begin, by the sections' numbers
        let mut begins = Vec::new();
        for payload in Parser::new(0).parse_all(bytes) {
            let payload = payload?;
            let section = payload.as_section();
            begins.extend(section.map(|(_, range)| range.start));
            match payload {
                Payload::ImportSection(imports) => {
                    for import in imports.into_imports() {
                        read.imported += u32::from(matches!(import?.ty, TypeRef::Func(_)));
                    }
                }
                Payload::CodeSectionEntry(body) => read.bodies.push(body.range()),
                Payload::DataSection(data) => {
                    for data in data {
                        let data = data?;
                        let begin = data.range.end - data.data.len();
                        if let DataKind::Active { offset_expr, .. } = data.kind
                            && let Operator::I32Const { value } =
                                offset_expr.get_operators_reader().read()?
                        {
                            read.segments.push((begin..data.range.end, value.cast_unsigned()));
                        }
                    }
                }
                Payload::CustomSection(custom) => match custom.as_known() {
                    KnownCustom::Name(names) => read.names = names_of(names)?,
                    KnownCustom::Linking(linking) => symbols = symbols_of(linking)?,
                    KnownCustom::Reloc(section) => relocations.push(section),
                    _ => {}
                },
                _ => {}
            }
        }
        read.symbols = symbols.into_iter().map(|symbol| read.addresses(symbol?)).collect();
        for section in relocations {
            let begin = begins.get(section.section_index() as usize).copied().unwrap_or_default();
            for entry in section.entries() {
                let entry = entry?;
                if is_of_memory(entry.ty) {
                    let at = begin + entry.offset as usize;
                    let is_code = read.bodies.last().is_some_and(|last| at < last.end);
                    let all = if is_code { &mut read.of_code } else { &mut read.of_data };
                    all.push(Reference { at, symbol: entry.index });
                }
            }
        }
        read.of_data.sort_by_key(|reference| reference.at);
        Ok(read)
    }

    /// The addresses of a symbol.
    fn addresses(&self, symbol: DefinedDataSymbol) -> Option<Addresses> {
        let (_, begin) = self.segments.get(symbol.index as usize)?;
        let begin = begin + symbol.offset;
        Some(begin..begin + symbol.size)
    }

    /// The address of what stands at a place of the file, where that is data.
    fn address(&self, at: usize) -> Option<u32> {
        let (place, begin) = self.segments.iter().find(|(place, _)| place.contains(&at))?;
        u32::try_from(at - place.start).ok().map(|from| begin + from)
    }

    /// Whether a place of the code is in a function of the rest.
    fn is_of_rest(&self, at: usize, rest: &BTreeSet<&str>) -> bool {
        let body = self.bodies.partition_point(|body| body.end <= at);
        let function = u32::try_from(body).ok().map(|own| self.imported + own);
        function.and_then(|own| self.names.get(&own)).is_some_and(|name| rest.contains(name))
    }

    fn late(&self, rest: &BTreeSet<&str>) -> Vec<Addresses> {
        // which bytes each symbol's data name, and what of the data is of no symbol
        let named: BTreeMap<u32, u32> = self
            .of_data
            .iter()
            .filter_map(|reference| Some((self.address(reference.at)?, reference.symbol)))
            .collect();
        let known = united(self.symbols.iter().flatten().cloned());
        let is_known = |address: u32| {
            let after = known.partition_point(|range| range.end <= address);
            known.get(after).is_some_and(|range| range.contains(&address))
        };
        let from_code =
            self.of_code.iter().filter(|reference| !self.is_of_rest(reference.at, rest));
        let from_nowhere = named.iter().filter(|(address, _)| !is_known(**address));
        let mut todo: Vec<u32> = from_code.map(|reference| reference.symbol).collect();
        todo.extend(from_nowhere.map(|(_, symbol)| symbol));
        let mut early = BTreeSet::new();
        while let Some(symbol) = todo.pop() {
            let Some(Some(range)) = self.symbols.get(symbol as usize) else { continue };
            if early.insert(symbol) {
                todo.extend(named.range(range.clone()).map(|(_, symbol)| *symbol));
            }
        }
        let (early, late): (Vec<_>, Vec<_>) = (0..)
            .zip(&self.symbols)
            .filter_map(|(symbol, range)| Some((early.contains(&symbol), range.clone()?)))
            .partition(|(is_early, _)| *is_early);
        let ranges = |of: Vec<(bool, Addresses)>| united(of.into_iter().map(|(_, range)| range));
        let late = without(&ranges(late), &ranges(early));
        late.into_iter().filter(|range| range.len() >= LEAST).collect()
    }
}

/// So many bytes are worth a segment of their own.
const LEAST: usize = 12;

/// Ranges in order, those that touch as one.
fn united(ranges: impl Iterator<Item = Addresses>) -> Vec<Addresses> {
    let mut all: Vec<Addresses> = ranges.filter(|range| !range.is_empty()).collect();
    all.sort_by_key(|range| range.start);
    let mut united: Vec<Addresses> = Vec::new();
    for range in all {
        match united.last_mut() {
            Some(last) if range.start <= last.end => last.end = last.end.max(range.end),
            _ => united.push(range),
        }
    }
    united
}

/// What of some ranges is in none of others; both in order, and none touches another of its own.
fn without(ranges: &[Addresses], others: &[Addresses]) -> Vec<Addresses> {
    let mut left = Vec::new();
    for range in ranges {
        let mut from = range.start;
        let first = others.partition_point(|other| other.end <= range.start);
        for other in others[first..].iter().take_while(|other| other.start < range.end) {
            if from < other.start {
                left.push(from..other.start);
            }
            from = from.max(other.end);
        }
        if from < range.end {
            left.push(from..range.end);
        }
    }
    left
}

/// Whether a relocation is of an address of the memory.
fn is_of_memory(kind: RelocationType) -> bool {
    use RelocationType::{MemoryAddrI32, MemoryAddrLeb, MemoryAddrSleb};
    matches!(kind, MemoryAddrI32 | MemoryAddrLeb | MemoryAddrSleb)
}

fn names_of(parts: NameSectionReader<'_>) -> Result<BTreeMap<u32, &str>> {
    let mut names = BTreeMap::new();
    for part in parts {
        if let Name::Function(functions) = part? {
            for function in functions {
                let function = function?;
                names.insert(function.index, function.name);
            }
        }
    }
    Ok(names)
}

fn symbols_of(linking: LinkingSectionReader<'_>) -> Result<Vec<Option<DefinedDataSymbol>>> {
    let mut all = Vec::new();
    for part in linking {
        if let Linking::SymbolTable(symbols) = part? {
            for symbol in symbols {
                all.push(match symbol? {
                    SymbolInfo::Data { symbol, .. } => symbol,
                    _ => None,
                });
            }
        }
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_in_two_ranges_is_taken_from_both() {
        let ranges = united([4..8, 0..2, 8..10, 20..30].into_iter());
        assert_eq!(ranges, [0..2, 4..10, 20..30]);
        assert_eq!(without(&ranges, &[1..5, 22..23, 29..40]), [0..1, 5..10, 20..22, 23..29]);
    }
}
