# Hard cases: one job each, so that a change reruns what depends on it; a case that fails is a row
# of the table that says so, not a failed job.


rule measure_hard_case:
    input:
        model=hard_case_model,
    output:
        "results/hard_cases/{case}.csv",
    log:
        "results/logs/measure_hard_case/{case}.log",
    benchmark:
        "results/benchmarks/measure_hard_case/{case}.tsv"
    conda:
        "../../envs/learning.yaml"
    threads: 1
    resources:
        mem_mb=2000,
        runtime=10,
    params:
        code=hard_case_code,
        model=lambda wildcards, input: ("--model results/models/forecast" if input.model else ""),
    message:
        "hard case {wildcards.case}"
    shell:
        "sedfiber measure_hard_case {wildcards.case} {params.model} -o {output} > {log} 2>&1"


rule tabulate_hard_cases:
    input:
        cases=expand("results/hard_cases/{case}.csv", case=HARD_CASES),
    output:
        "results/tables/hard_cases.csv",
    log:
        "results/logs/tabulate_hard_cases.log",
    benchmark:
        "results/benchmarks/tabulate_hard_cases.tsv"
    conda:
        "../../envs/analysis.yaml"
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=code_of("tabulate_hard_cases"),
    message:
        "tabulate all hard cases"
    shell:
        "sedfiber tabulate_hard_cases {input.cases} -o {output} > {log} 2>&1"


rule hard_cases:
    input:
        figures_of("hard_cases"),
